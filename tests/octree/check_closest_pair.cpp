#include <gtest/gtest.h>

#include "src/check/closest_pair.h"
#include "tests/octree/octree_clouds.h"

namespace stipple::test::octree_check_closest_pair {
namespace {

double by_trying_all(const std::vector<glm::ivec3>& points, const glm::dvec3& scale) {
  double closest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t j = i + 1; j < points.size(); ++j)
      closest = std::min(closest, glm::distance(glm::dvec3(points[i]) * scale, glm::dvec3(points[j]) * scale));
  return closest;
}

TEST(ClosestPair, IsTheOneFoundByTryingAll) {
  const glm::dvec3 scale(0.01, 0.02, 1.0);
  for (unsigned seed = 0; seed < 200; ++seed) {
    const int edge = 1 << (seed % 20);
    const auto points = test::random_positions(2 + seed, {{-edge, -edge, 0}, {edge, edge, edge / 50}}, seed);
    ASSERT_NEAR(closest_pair(points, scale), by_trying_all(points, scale), 1e-9) << "seed " << seed;
  }
}

TEST(ClosestPair, OfFewerThanTwoPointsIsInfinite) {
  EXPECT_TRUE(std::isinf(closest_pair({}, glm::dvec3(1.0))));
  EXPECT_TRUE(std::isinf(closest_pair(std::vector{glm::ivec3(7)}, glm::dvec3(1.0))));
}

TEST(ClosestPair, OfTheEndsOfTheGridDoesNotOverflow) {
  const std::vector points{glm::ivec3(std::numeric_limits<int>::min()), glm::ivec3(std::numeric_limits<int>::max())};
  EXPECT_NEAR(closest_pair(points, glm::dvec3(1.0)), std::sqrt(3.0) * 4294967295.0, 1.0);
}

TEST(ClosestPair, OfManyPointsIsFoundInTimeWhereverTheyAre) {
  constexpr std::size_t kPoints = 200'000;
  const std::vector<glm::ivec3> equal(kPoints, glm::ivec3(5));
  EXPECT_EQ(closest_pair(equal, glm::dvec3(0.1)), 0.0);
  std::vector<glm::ivec3> line(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) line[i].x = 3 * static_cast<int>(i);
  EXPECT_EQ(closest_pair(line, glm::dvec3(1.0)), 3.0);
  // One far away: cells are sized by the closest, not by the box
  line[0].x = std::numeric_limits<int>::min();
  EXPECT_EQ(closest_pair(line, glm::dvec3(1.0)), 3.0);
}

}  // namespace
}  // namespace stipple::test::octree_check_closest_pair
