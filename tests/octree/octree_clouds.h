// Clouds that octrees are tested on, each with what it is there to break.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <ostream>
#include <random>
#include <string>
#include <vector>

#include "octree/cloud/grid.h"

namespace stipple::test {

struct TestCloud {
  std::string name;
  std::vector<glm::ivec3> positions;
  Grid grid{{1000.0, -2000.0, 30.0}, glm::dvec3(0.01)};

  GridBox bounds() const {
    GridBox box;
    for (const glm::ivec3& p : positions) box.extend(p);
    return box;
  }
};

inline void PrintTo(const TestCloud& cloud, std::ostream* out) {
  *out << cloud.name;
}

inline std::string cloud_name(const testing::TestParamInfo<TestCloud>& cloud) {
  return cloud.param.name;
}

// Uniform in the box, corners included.
inline std::vector<glm::ivec3> random_positions(std::size_t count, const GridBox& box, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<glm::ivec3> positions(count);
  for (glm::ivec3& p : positions)
    for (int axis = 0; axis < 3; ++axis)
      p[axis] = std::uniform_int_distribution<std::int32_t>(box.min[axis], box.max[axis])(random);
  return positions;
}

// Hills with trees: a surface, some of it vertical, density varying by place.
inline std::vector<glm::ivec3> terrain(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<glm::ivec3> positions(count);
  for (glm::ivec3& p : positions) {
    const double x = unit(random) * unit(random), y = unit(random);
    const double tree = unit(random) < 0.2 ? unit(random) * 0.02 : 0.0;
    p = glm::ivec3(glm::dvec3(x, y, 0.05 * std::sin(9.0 * x) * std::cos(7.0 * y) + tree) * 1e6);
  }
  return positions;
}

inline std::vector<TestCloud> test_clouds() {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kHigh = std::numeric_limits<std::int32_t>::max();
  std::vector<TestCloud> clouds;
  clouds.push_back({"none", {}});                                                              // no root
  clouds.push_back({"one", {{7, -8, 9}}});                                                     // no extent
  clouds.push_back({"equal", std::vector<glm::ivec3>(200'000, {5, 5, 5})});                    // endless splitting
  clouds.push_back({"line", random_positions(20'000, {{3, 0, 0}, {3, 1'000'000, 0}}, 1)});     // two flat axes
  clouds.push_back({"plane", random_positions(20'000, {{0, 0, 9}, {50'000, 50'000, 9}}, 2)});  // one flat axis
  clouds.push_back({"terrain", terrain(40'000, 3)});                                           // the usual
  clouds.push_back({"volume", random_positions(20'000, {{-500, -500, -500}, {500, 500, 500}}, 4)});  // all sampled away
  clouds.push_back({"duplicates", random_positions(30'000, {{0, 0, 0}, {3, 3, 3}}, 5)});  // full leaves, many codes

  TestCloud far_apart{"two_far_clusters", random_positions(15'000, {{0, 0, 0}, {900, 900, 90}}, 6)};  // deep chunks
  for (glm::ivec3 p : random_positions(15'000, {{0, 0, 0}, {900, 900, 90}}, 7))
    far_apart.positions.push_back(p + glm::ivec3(100'000'000));
  clouds.push_back(far_apart);

  TestCloud outlier{"outlier", terrain(20'000, 8)};  // bounds that say nothing about where the points are
  outlier.positions.push_back(glm::ivec3(2'000'000'000));
  clouds.push_back(outlier);

  TestCloud extremes{"int32_extremes", random_positions(20'000, {glm::ivec3(kLow), glm::ivec3(kHigh)}, 9)};  // overflow
  for (int corner = 0; corner < 8; ++corner)
    extremes.positions.push_back({corner & 1 ? kLow : kHigh, corner & 2 ? kLow : kHigh, corner & 4 ? kLow : kHigh});
  clouds.push_back(extremes);

  TestCloud anisotropic{"anisotropic",
                        random_positions(20'000, {{0, 0, 0}, {9'000, 90'000, 900}}, 10)};  // grid != world
  anisotropic.grid.scale = {0.1, 0.001, 1.0};
  clouds.push_back(anisotropic);
  return clouds;
}

}  // namespace stipple::test
