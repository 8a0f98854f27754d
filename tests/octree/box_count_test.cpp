#include "octree/build/box_count.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <set>
#include <vector>

namespace stipple::test::octree_box_count_test {
namespace {

std::vector<CodedPoint> sorted_points(std::size_t count, int shift, unsigned seed) {
  std::mt19937_64 random(seed);
  std::vector<CodedPoint> points;
  for (std::size_t i = 0; i < count; ++i) points.push_back({random() >> shift, 0, static_cast<std::uint32_t>(i)});
  std::sort(points.begin(), points.end());
  return points;
}

TEST(BoxCount, ProfileIsTheNumberOfDistinctCellsOnEachLevel) {
  for (int shift = 1; shift <= 64 - 1; shift += 6) {
    const auto points = sorted_points(3'000, shift, static_cast<unsigned>(shift));
    const BoxCounts counts = box_counts(points);
    for (int level = 0; level <= kMaxLevel; ++level) {
      std::set<std::uint64_t> cells;
      for (const CodedPoint& point : points) cells.insert(point.code >> bits_below(level));
      ASSERT_EQ(counts.occupied[level], cells.size()) << "level " << level << ", shift " << shift;
    }
  }
}

TEST(BoxCount, ProfileOfEqualCodesIsOneEverywhere) {
  const std::vector<CodedPoint> points(1'000, {12345, 0, 0});
  for (const std::uint32_t occupied : box_counts(points).occupied) EXPECT_EQ(occupied, 1u);
}

TEST(BoxCount, ProfileOfNothingIsZero) {
  for (const std::uint32_t occupied : box_counts({}).occupied) EXPECT_EQ(occupied, 0u);
}

}  // namespace
}  // namespace stipple::test::octree_box_count_test
