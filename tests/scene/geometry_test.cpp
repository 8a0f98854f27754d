// What sets each generated scene apart: storeys, falling density, length.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <vector>

#include "octree/cloud/cloud.h"
#include "src/scene/city.h"
#include "src/scene/corridor.h"
#include "src/scene/interior.h"
#include "src/scene/random.h"
#include "src/scene/scene.h"
#include "src/scene/solid_tree.h"
#include "src/scene/trig.h"

namespace stipple::scene::test_geometry_test {
namespace {

TEST(City, CoversOneSquareKilometreHoweverManyPoints) {
  for (const std::uint64_t points : {20'000, 160'000}) {
    const Cloud cloud = load_cloud(*make_scene("city", points, 1), {});
    const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
    EXPECT_NEAR(box.max.x - box.min.x, 1000, 2);
    EXPECT_NEAR(box.max.y - box.min.y, 1000, 2);
    EXPECT_GT(box.max.z - box.min.z, 40);
  }
}

// One block of a city of 40 M points, dense enough to tell storeys apart.
std::vector<ScenePoint> city_block() {
  constexpr std::uint64_t kPoints = 40'000'000;
  const auto city = make_city(kPoints, 1);
  std::vector<ScenePoint> points;
  for (std::uint64_t i = kPoints / 2; i < kPoints / 2 + 200'000; ++i) points.push_back(city->point(i));
  return points;
}

TEST(City, BuildingsHaveStoreysInside) {
  // Heights that occur in columns of 2 m x 2 m
  std::map<std::pair<int, int>, std::set<int>> columns;
  for (const ScenePoint& p : city_block())
    if (p.point_class == PointClass::building)
      columns[{static_cast<int>(p.position.x / 2), static_cast<int>(p.position.y / 2)}].insert(
          static_cast<int>(p.position.z));
  // A layer is a run of occupied metres below an empty one
  int deep = 0;
  for (const auto& [column, heights] : columns) {
    int layers = 0;
    for (const int z : heights) layers += !heights.contains(z + 1);
    deep += layers >= 3;
  }
  EXPECT_GT(columns.size(), 300u);
  EXPECT_GT(deep, static_cast<int>(columns.size() / 3));
}

TEST(City, PointIsAFunctionOfItsIndex) {
  constexpr std::uint64_t kPoints = 200'000;
  const auto city = make_city(kPoints, 1);
  const Cloud cloud = load_cloud(*make_scene("city", kPoints, 1), {});
  for (std::uint64_t i = kPoints; i-- > 0; i -= std::min<std::uint64_t>(i, 997)) {
    const glm::dvec3 cell = city->point(i).position / cloud.info.grid.scale;
    EXPECT_LE(glm::length(cell - glm::dvec3(cloud.positions[i])), 0.9);
  }
}

TEST(Interior, DensityFallsWithTheSquareOfTheDistance) {
  // The first scan stands in the hall: points on its floor, in rings around it
  const auto scans = interior_scanners().size();
  constexpr std::uint64_t kPerScan = 60'000;
  const auto interior = make_interior(kPerScan * scans, 1);
  const glm::dvec3 scanner = interior_scanners()[0];
  const auto ring = [&](double from, double to) {
    int count = 0;
    for (std::uint64_t i = 0; i < kPerScan; ++i) {
      const glm::dvec3 p = interior->point(i).position;
      const double away = glm::length(glm::dvec2(p - scanner));
      count += std::abs(p.z) < 0.03 && away >= from && away < to;
    }
    return count / (to * to - from * from);
  };
  // On a floor h below, equal angular steps leave h / (d (d^2 + h^2)) points: about a tenth from 1.5 m to 4 m
  const double near = ring(1.3, 1.7);
  const double far = ring(3.8, 4.2);
  EXPECT_GT(near, 4 * far);
  EXPECT_LT(near, 30 * far);
  EXPECT_GT(far, 0);
}

TEST(Interior, ScannersStandFree) {
  const auto scans = interior_scanners().size();
  constexpr std::uint64_t kPerScan = 3000;
  const auto interior = make_interior(kPerScan * scans, 1);
  for (std::uint64_t scan = 0; scan < scans; ++scan) {
    std::vector<double> ranges;
    for (std::uint64_t i = scan * kPerScan; i < (scan + 1) * kPerScan; ++i)
      ranges.push_back(glm::length(interior->point(i).position - interior_scanners()[scan]));
    std::ranges::sort(ranges);
    EXPECT_GT(ranges.front(), 0.3) << "scan " << scan;
    EXPECT_LT(ranges.back(), 45) << "scan " << scan;
    EXPECT_GT(ranges[ranges.size() / 2], 1.5) << "scan " << scan;
  }
}

TEST(Corridor, IsAHundredKilometresLongInUtmCoordinates) {
  const Cloud cloud = load_cloud(*make_scene("corridor", 100'000, 1), {});
  const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
  EXPECT_GT(glm::length(glm::dvec2(box.max - box.min)), 100'000);
  // Zone limits at these latitudes: 166 km to 834 km east, and metres north of the equator below 10,000 km
  EXPECT_GT(box.min.x, 166'000);
  EXPECT_LT(box.max.x, 834'000);
  EXPECT_NEAR(box.min.y, 5'300'000, 5000);
  EXPECT_NEAR(box.max.y, 5'300'000, 5000);
}

TEST(Corridor, ComesFromWestToEastInANarrowStrip) {
  constexpr std::uint64_t kPoints = 100'000;
  const auto corridor = make_corridor(kPoints, 1);
  double reached = -100;
  for (std::uint64_t i = 0; i < kPoints; i += 50) {
    const double x = corridor->point(i).position.x;
    EXPECT_GT(x, reached - 150);
    reached = std::max(reached, x);
  }
}

TEST(SolidTree, FindsTheSameHitAsTryingEverySolid) {
  PointRandom random(7, 0);
  std::vector<Solid> solids;
  for (int i = 0; i < 200; ++i) {
    Solid solid;
    solid.centre = {random.uniform(-10, 10), random.uniform(-10, 10), random.uniform(-10, 10)};
    solid.half = {random.uniform(0.1, 1.5), random.uniform(0.1, 1.5), random.uniform(0.1, 1.5)};
    solid.round = i % 3 == 0;
    if (solid.round) solid.half.y = solid.half.x;
    solid.axis = glm::vec2(direction_from_turns(random.uniform()));
    solids.push_back(solid);
  }
  const SolidTree tree(solids);
  std::vector<SolidTree> singles;
  for (const Solid& solid : solids) singles.push_back(SolidTree({solid}));
  int hits = 0;
  for (int i = 0; i < 3000; ++i) {
    const glm::vec3 origin(random.uniform(-20, -15), random.uniform(-10, 10), random.uniform(-10, 10));
    const glm::vec3 direction(1, random.uniform(-0.5, 0.5), random.uniform(-0.5, 0.5));
    float nearest = std::numeric_limits<float>::infinity();
    for (const SolidTree& single : singles) nearest = std::min(nearest, single.cast(origin, direction).range);
    EXPECT_EQ(tree.cast(origin, direction).range, nearest);
    hits += nearest < 100;
  }
  EXPECT_GT(hits, 500);
}

TEST(SolidTree, EntersACylinderAtItsRadius) {
  Solid pillar;
  pillar.half = {0.5f, 0.5f, 2.0f};
  pillar.round = true;
  const SolidTree tree({pillar});
  const Hit side = tree.cast({-3, 0, 0}, {1, 0, 0});
  EXPECT_FLOAT_EQ(side.range, 2.5f);
  EXPECT_FLOAT_EQ(side.normal.x, -1.0f);
  EXPECT_FLOAT_EQ(tree.cast({0.1f, 0, 5}, {0, 0, -1}).range, 3.0f);
  EXPECT_TRUE(std::isinf(tree.cast({-3, 0.6f, 0}, {1, 0, 0}).range));
}

TEST(Trig, AgreesWithLibm) {
  for (int i = -3000; i < 3000; ++i) {
    const double turns = i / 700.0;
    EXPECT_NEAR(sin_turns(turns), std::sin(turns * 6.283185307179586), 1e-11);
    EXPECT_NEAR(cos_turns(turns), std::cos(turns * 6.283185307179586), 1e-11);
  }
}

}  // namespace
}  // namespace stipple::scene::test_geometry_test
