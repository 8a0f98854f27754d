#include "render/measure/percentile.h"

#include <gtest/gtest.h>

namespace stipple::test::measure_percentile {
namespace {

TEST(Percentile, IsTheNearestRank) {
  const std::vector<double> values{50, 15, 40, 20, 35};
  EXPECT_EQ(percentile(values, 5), 15);
  EXPECT_EQ(percentile(values, 30), 20);
  EXPECT_EQ(percentile(values, 40), 20);
  EXPECT_EQ(percentile(values, 41), 35);
  EXPECT_EQ(percentile(values, 50), 35);
  EXPECT_EQ(percentile(values, 95), 50);
  EXPECT_EQ(percentile(values, 100), 50);
}

TEST(Percentile, OfAHundredNumbersIsTheNumberItself) {
  std::vector<int> values;
  for (int i = 1; i <= 100; ++i) values.push_back(i * 37 % 101);
  for (int p = 1; p <= 100; ++p) EXPECT_EQ(percentile(values, p), p);
}

TEST(Percentile, OfOneValueIsThatValueAndOfNoneZero) {
  for (const double p : {0.001, 50.0, 99.0, 100.0}) EXPECT_EQ(percentile(std::vector<double>{7.5}, p), 7.5);
  EXPECT_EQ(percentile(std::vector<double>{}, 50), 0.0);
}

}  // namespace
}  // namespace stipple::test::measure_percentile
