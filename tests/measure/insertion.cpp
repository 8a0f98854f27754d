// The shuffle that grows.
#include "render/store/insertion.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stipple::test::measure_insertion {
namespace {

// Ids by slot, after new points first, first + 1, ...
void insert(std::vector<std::uint32_t>& array, std::uint32_t points, std::uint64_t& state) {
  const auto taken = static_cast<std::uint32_t>(array.size());
  const Insertion insertion = plan_insertion(taken, points, state);
  ASSERT_EQ(insertion.points(), points);
  std::vector<std::uint32_t> staged(points);
  std::iota(staged.begin(), staged.end(), taken);
  for (const std::uint32_t slot : insertion.displaced) {
    ASSERT_LT(slot, taken);
    staged.push_back(array[slot]);
  }
  array.resize(taken + points);
  for (std::size_t i = 0; i < staged.size(); ++i) array.at(insertion.slots[i]) = staged[i];
}

TEST(Insertion, KeepsAPermutation) {
  std::uint64_t state = 1;
  std::vector<std::uint32_t> array;
  for (const std::uint32_t points : {0u, 1u, 1u, 2u, 30u, 1'000u, 0u, 17u, 40'000u}) {
    insert(array, points, state);
    std::vector<std::uint32_t> sorted = array;
    std::ranges::sort(sorted);
    for (std::uint32_t i = 0; i < sorted.size(); ++i) ASSERT_EQ(sorted[i], i);
  }
}

TEST(Insertion, DisplacedPointsGoToTheEnd) {
  std::uint64_t state = 1;
  const Insertion insertion = plan_insertion(10'000, 500, state);
  for (std::size_t d = 0; d < insertion.displaced.size(); ++d) EXPECT_GE(insertion.slots[500 + d], 10'000u);
  EXPECT_GT(insertion.displaced.size(), 400u);
}

// Every arrangement of five points that come in batches of 2, 1 and 2 is as likely as any other.
TEST(Insertion, IsAUniformShuffleAtEachMoment) {
  constexpr int kRuns = 120'000;
  std::vector<int> counts(3'125);
  std::uint64_t state = 7;
  for (int run = 0; run < kRuns; ++run) {
    std::vector<std::uint32_t> array;
    for (const std::uint32_t points : {2u, 1u, 2u}) insert(array, points, state);
    std::size_t number = 0;
    for (const std::uint32_t id : array) number = 5 * number + id;
    ++counts[number];
  }
  std::erase(counts, 0);
  ASSERT_EQ(counts.size(), 120u);
  double chi_square = 0.0;
  for (const int count : counts) chi_square += (count - 1'000.0) * (count - 1'000.0) / 1'000.0;
  EXPECT_LT(chi_square, 180.0);  // 119 degrees of freedom: exceeded once in 5,000 draws
}

TEST(Insertion, AnyStretchIsAnEvenSampleOfWhatIsThere) {
  std::uint64_t state = 3;
  std::vector<std::uint32_t> array;
  for (int batch = 0; batch < 20; ++batch) {
    insert(array, 1'000, state);
    // How many of the first tenth of the slots came with each batch
    const std::size_t stretch = array.size() / 10;
    std::vector<double> counts(static_cast<std::size_t>(batch) + 1);
    for (std::size_t slot = 0; slot < stretch; ++slot) ++counts[array[slot] / 1'000];
    const double expected = static_cast<double>(stretch) / static_cast<double>(counts.size());
    for (const double count : counts) EXPECT_NEAR(count, expected, 6.0 * std::sqrt(expected)) << batch;
  }
}

}  // namespace
}  // namespace stipple::test::measure_insertion
