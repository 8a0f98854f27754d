#include "octree/build/morton.h"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "tests/octree/octree_clouds.h"

namespace stipple::test::octree_morton_test {
namespace {

constexpr int kTrials = 100'000;

glm::uvec3 random_cell(std::mt19937& random) {
  std::uniform_int_distribution<std::uint32_t> cell(0, kFinestCells - 1);
  return {cell(random), cell(random), cell(random)};
}

// Child by child from the root, as node.children is indexed.
std::array<unsigned, kMaxLevel> octants(const glm::uvec3& cell) {
  std::array<unsigned, kMaxLevel> path{};
  glm::uvec3 low(0);
  std::uint32_t edge = kFinestCells;
  for (unsigned& octant : path) {
    edge /= 2;
    for (int axis = 0; axis < 3; ++axis) {
      const bool upper = cell[axis] >= low[axis] + edge;
      octant = octant * 2 + upper;
      low[axis] += upper ? edge : 0;
    }
  }
  return path;
}

TEST(Morton, DecodingReturnsWhatWasEncoded) {
  std::mt19937 random(1);
  for (int i = 0; i < kTrials; ++i) {
    const glm::uvec3 cell = random_cell(random);
    ASSERT_EQ(morton_decode(morton_encode(cell)), cell);
  }
  const glm::uvec3 last(kFinestCells - 1);
  EXPECT_EQ(morton_encode(last), (std::uint64_t{1} << 63) - 1);
  EXPECT_EQ(morton_decode(morton_encode(last)), last);
}

TEST(Morton, OrderAgreesWithDescentByOctants) {
  std::mt19937 random(2);
  for (int i = 0; i < kTrials; ++i) {
    const glm::uvec3 a = random_cell(random);
    // Half of the pairs are neighbours, which share most of their path.
    const glm::uvec3 b = i % 2 ? random_cell(random) : a ^ (random_cell(random) >> 15u);
    ASSERT_EQ(morton_encode(a) < morton_encode(b), octants(a) < octants(b));
  }
}

TEST(Morton, DigitsAreTheOctantsOfTheDescent) {
  std::mt19937 random(3);
  for (int i = 0; i < 1'000; ++i) {
    const glm::uvec3 cell = random_cell(random);
    for (int level = 1; level <= kMaxLevel; ++level)
      ASSERT_EQ(morton_digit(morton_encode(cell), level), octants(cell)[level - 1]);
  }
}

TEST(Morton, CommonLevelIsTheLengthOfTheSharedPath) {
  std::mt19937 random(4);
  for (int i = 0; i < kTrials; ++i) {
    const glm::uvec3 a = random_cell(random);
    const glm::uvec3 b = a ^ (random_cell(random) >> static_cast<unsigned>(i % 22));
    const auto path_a = octants(a), path_b = octants(b);
    const auto end = std::mismatch(path_a.begin(), path_a.end(), path_b.begin()).first;
    ASSERT_EQ(common_level(morton_encode(a), morton_encode(b)), end - path_a.begin());
  }
}

class QuantizerOf : public testing::TestWithParam<test::TestCloud> {};
INSTANTIATE_TEST_SUITE_P(Clouds, QuantizerOf, testing::ValuesIn(test::test_clouds()), test::cloud_name);

TEST_P(QuantizerOf, CubeHoldsEveryPointAndHasAnEdge) {
  const test::TestCloud& cloud = GetParam();
  const RootCube cube = root_cube(cloud.grid, cloud.bounds());
  EXPECT_GT(cube.edge, 0.0);
  for (const glm::ivec3& p : cloud.positions) {
    const glm::dvec3 from_corner = cloud.grid.world_from_grid(p) - cube.min;
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(from_corner, glm::dvec3(0.0))));
    ASSERT_TRUE(glm::all(glm::lessThanEqual(from_corner, glm::dvec3(cube.edge))));
  }
}

TEST_P(QuantizerOf, CellIsWhereThePointIsInTheCube) {
  const test::TestCloud& cloud = GetParam();
  const GridBox bounds = cloud.bounds();
  if (bounds.empty()) GTEST_SKIP() << "no point to quantise";
  const Quantizer quantizer(cloud.grid, bounds);
  const RootCube cube = root_cube(cloud.grid, bounds);
  for (const glm::ivec3& p : cloud.positions) {
    const glm::uvec3 cell = quantizer.cell(p);
    const glm::dvec3 exact = (glm::dvec3(p) - glm::dvec3(bounds.min)) * cloud.grid.scale / cube.edge * 2097152.0;
    for (int axis = 0; axis < 3; ++axis) {
      ASSERT_LT(cell[axis], kFinestCells);
      ASSERT_GE(exact[axis], cell[axis] - 1e-6);
      ASSERT_LT(exact[axis], cell[axis] + 1 + 1e-6);
    }
  }
}

TEST(Quantizer, BorderBelongsToTheUpperCell) {
  // Sixteen steps: every cell of level 4 is one step.
  const Quantizer quantizer(Grid{}, {glm::ivec3(0), glm::ivec3(15)});
  for (int x = 0; x < 16; ++x) EXPECT_EQ(quantizer.cell({x, 0, 0}).x, static_cast<unsigned>(x) << 17);
}

TEST(Quantizer, DirectionsWithUnequalScalesShareOneWorldCube) {
  // 100 world units along x, 1 along y.
  const Quantizer quantizer(Grid{glm::dvec3(0.0), {0.1, 0.001, 0.1}}, {glm::ivec3(0), {999, 999, 0}});
  EXPECT_EQ(quantizer.cell({999, 0, 0}).x >> 14, 127u);
  EXPECT_EQ(quantizer.cell({0, 999, 0}).y >> 14, 1u);
}

TEST(Quantizer, NeverFallsAlongAnAxis) {
  constexpr std::int32_t kLow = std::numeric_limits<std::int32_t>::min();
  constexpr std::int32_t kHigh = std::numeric_limits<std::int32_t>::max();
  const Quantizer quantizer(Grid{glm::dvec3(0.0), glm::dvec3(0.001)}, {glm::ivec3(kLow), glm::ivec3(kHigh)});
  std::uint32_t before = 0;
  for (std::int64_t x = kLow; x <= kHigh; x += 40'009) {
    const std::uint32_t cell = quantizer.cell({static_cast<std::int32_t>(x), 0, 0}).x;
    ASSERT_GE(cell, before);
    before = cell;
  }
  EXPECT_EQ(quantizer.cell(glm::ivec3(kHigh)), glm::uvec3(kFinestCells - 1));
}

}  // namespace
}  // namespace stipple::test::octree_morton_test
