// The stages of building, one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "octree/build/chunks.h"
#include "octree/build/sampling.h"
#include "octree/build/sort.h"

namespace stipple::test::octree_build_stages_test {
namespace {

// `spread` bits of code are random, the rest is zero; few bits give many equal codes.
std::vector<CodedPoint> random_points(std::size_t count, int spread, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const Ranking ranking(seed);
  std::vector<CodedPoint> points;
  for (std::uint32_t id = 0; id < count; ++id)
    points.push_back({spread == 0 ? 0 : random() >> (64 - spread), id, ranking(id)});
  return points;
}

bool same(const CodedPoint& a, const CodedPoint& b) {
  return a.code == b.code && a.id == b.id && a.rank == b.rank;
}

TEST(Ranking, GivesEveryIdItsOwnRank) {
  const Ranking ranking(42);
  // A bijection of 32 bits: too many ids to try all in a test.
  std::vector<std::uint32_t> ranks;
  for (std::uint32_t id = 0; id < 1'000'000; ++id) ranks.push_back(ranking(id * 4'001));
  std::sort(ranks.begin(), ranks.end());
  EXPECT_EQ(std::adjacent_find(ranks.begin(), ranks.end()), ranks.end());
}

TEST(SortPoints, GivesTheOrderThatComparingGives) {
  for (const int spread : {63, 40, 17, 3, 0}) {
    auto points = random_points(50'000, spread, 7);
    auto expected = points;
    std::sort(expected.begin(), expected.end());
    std::vector<CodedPoint> scratch(points.size());
    sort_points(points, scratch, 0);
    EXPECT_TRUE(std::equal(points.begin(), points.end(), expected.begin(), same)) << spread << " bits";
  }
}

TEST(SampleLevels, PointHoldsTheTopmostLatticeCellInWhichItsRankIsLowest) {
  for (const int spread : {63, 45, 30, 12, 0}) {
    auto points = random_points(4'000, spread, 11);
    std::sort(points.begin(), points.end());
    std::vector<std::uint8_t> level(points.size());
    sample_levels(points, level);

    std::vector<std::uint8_t> expected(points.size(), kNotSampled);
    for (int node_level = kMaxLevel; node_level >= 0; --node_level) {
      const int below = bits_below(std::min(node_level + kLatticeLevels, kMaxLevel));
      std::map<std::uint64_t, std::size_t> lowest;
      for (std::size_t i = 0; i < points.size(); ++i) {
        const auto [place, first] = lowest.try_emplace(points[i].code >> below, i);
        if (!first && points[i].rank < points[place->second].rank) place->second = i;
      }
      for (const auto& [cell, i] : lowest) expected[i] = static_cast<std::uint8_t>(node_level);
    }
    EXPECT_EQ(level, expected) << spread << " bits";
  }
}

TEST(SampleLevels, EveryPointOfACellIsChosenEquallyOften) {
  constexpr int kPoints = 8, kTrials = 8'000;
  std::array<int, kPoints> chosen{};
  for (std::uint64_t seed = 0; seed < kTrials; ++seed) {
    const Ranking ranking(seed);
    std::vector<CodedPoint> points;
    for (std::uint32_t id = 0; id < kPoints; ++id) points.push_back({id, id, ranking(id)});
    std::vector<std::uint8_t> level(points.size());
    sample_levels(points, level);
    ++chosen[std::find(level.begin(), level.end(), 0) - level.begin()];
  }
  double chi_square = 0.0;
  for (const int count : chosen) chi_square += std::pow(count - kTrials / kPoints, 2) / (kTrials / kPoints);
  EXPECT_LT(chi_square, 24.3);  // 7 degrees of freedom: exceeded once in 1,000 seeds
}

TEST(CellCounts, CountsPointsOfEachCell) {
  const auto points = random_points(10'000, 63, 3);
  CellCounts half(0), whole(0);
  whole.add(std::span(points).first(4'000));
  half.add(std::span(points).subspan(4'000));
  whole.add(half);
  std::map<std::size_t, std::size_t> expected;
  for (const CodedPoint& point : points) ++expected[point.code >> bits_below(whole.grid_level())];
  for (std::size_t cell = 0; cell < whole.size(); ++cell)
    ASSERT_EQ(whole[cell], expected.contains(cell) ? expected[cell] : 0);
}

TEST(MergeCells, ChunksAreTheLargestCellsWithinCapacity) {
  const auto points = random_points(10'000, 63, 5);
  CellCounts counts(0);
  counts.add(points);
  constexpr std::size_t kCapacity = 100;
  std::size_t total = 0;
  for (const Chunk& chunk : merge_cells(counts, 0, kCapacity).chunks) {
    EXPECT_EQ(chunk.first, total);
    total += chunk.count;
    const auto points_of = [&](int level) {
      return std::count_if(points.begin(), points.end(), [&](const CodedPoint& point) {
        return cell_code(point.code, level) == cell_code(chunk.code, level);
      });
    };
    EXPECT_EQ(points_of(chunk.level), chunk.count);
    EXPECT_LE(chunk.count, kCapacity);
    EXPECT_GT(points_of(chunk.level - 1), kCapacity);
  }
  EXPECT_EQ(total, points.size());
}

class DivideIntoChunks : public testing::TestWithParam<int> {};
INSTANTIATE_TEST_SUITE_P(BitsOfCode, DivideIntoChunks, testing::Values(63, 30, 20, 6, 0));

TEST_P(DivideIntoChunks, GivesEachChunkThePointsOfItsCell) {
  auto points = random_points(300'000, GetParam(), 5);
  constexpr std::size_t kCapacity = 1'000;
  std::size_t next = 0;
  for (const Chunk& chunk : divide_into_chunks(points, kCapacity)) {
    ASSERT_EQ(chunk.first, next);
    next += chunk.count;
    std::set<std::uint64_t> codes;
    for (const CodedPoint& point : std::span(points).subspan(chunk.first, chunk.count)) {
      ASSERT_EQ(cell_code(point.code, chunk.level), chunk.code);
      codes.insert(point.code);
    }
    EXPECT_TRUE(chunk.count <= kCapacity || codes.size() == 1);
  }
  EXPECT_EQ(next, points.size());
}

TEST_P(DivideIntoChunks, LosesNoPoint) {
  auto points = random_points(300'000, GetParam(), 5);
  auto expected = points;
  divide_into_chunks(points, 1'000);
  std::sort(points.begin(), points.end());
  std::sort(expected.begin(), expected.end());
  EXPECT_TRUE(std::equal(points.begin(), points.end(), expected.begin(), same));
}

TEST(DivideIntoChunks, TooManyEqualCodesAreOneChunkAtTheTopmostCellOfTheirOwn) {
  std::vector<CodedPoint> points = random_points(5'000, 0, 5);
  points.push_back({std::uint64_t{1} << 40, 5'000, 0});
  const std::vector<Chunk> chunks = divide_into_chunks(points, 1'000);
  ASSERT_EQ(chunks.size(), 2u);
  EXPECT_EQ(chunks[0].count, 5'000u);
  EXPECT_EQ(chunks[0].level, common_level(0, std::uint64_t{1} << 40) + 1);
}

}  // namespace
}  // namespace stipple::test::octree_build_stages_test
