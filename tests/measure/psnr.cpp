#include "render/measure/psnr.h"

#include <gtest/gtest.h>

#include <cmath>

#include "octree/core/error.h"

namespace stipple::test::measure_psnr {
namespace {

Image flat(const glm::ivec2& size, std::uint8_t value) {
  return {size, std::vector<std::uint8_t>(static_cast<std::size_t>(size.x * size.y) * 3, value)};
}

TEST(Psnr, OfAConstantDifferenceIsTheRatioToTheRange) {
  for (int d = 1; d <= 255; ++d) {
    const double mse = mean_squared_error(flat({7, 5}, 0), flat({7, 5}, static_cast<std::uint8_t>(d)));
    EXPECT_DOUBLE_EQ(mse, d * d);
    EXPECT_NEAR(psnr_db(mse), 20.0 * std::log10(255.0 / d), 1e-12);
  }
}

TEST(Psnr, OfIdenticalPicturesIsInfinite) {
  EXPECT_EQ(psnr_db(mean_squared_error(flat({3, 3}, 9), flat({3, 3}, 9))), std::numeric_limits<double>::infinity());
}

TEST(Psnr, MeanSquaredErrorCountsAllChannelsAndBothDirections) {
  Image a = flat({2, 1}, 100);
  Image b = a;
  b.rgb[0] = 103;
  b.rgb[4] = 96;
  EXPECT_DOUBLE_EQ(mean_squared_error(a, b), (9.0 + 16.0) / 6.0);
  EXPECT_DOUBLE_EQ(mean_squared_error(b, a), (9.0 + 16.0) / 6.0);
}

TEST(Psnr, OneDifferentBitIsNotLostInALargePicture) {
  const Image a = flat({2048, 2048}, 255);
  Image b = a;
  b.rgb.back() = 254;
  EXPECT_DOUBLE_EQ(mean_squared_error(a, b), 1.0 / (2048.0 * 2048.0 * 3.0));
}

TEST(Psnr, OfCoveredPixelsLeavesTheBackgroundOut) {
  const Image a = flat({4, 2}, 100);
  Image b = a;
  b.rgb[3] = 106;   // pixel 1
  b.rgb[21] = 200;  // pixel 7
  const std::vector<std::uint32_t> ids{5, 6, 7, 8, kNoPoint, kNoPoint, kNoPoint, kNoPoint};
  EXPECT_DOUBLE_EQ(covered_mean_squared_error(a, b, ids), 36.0 / 12.0);
  EXPECT_EQ(covered_mean_squared_error(a, b, std::vector<std::uint32_t>(8, kNoPoint)), 0.0);
  EXPECT_DOUBLE_EQ(covered_mean_squared_error(a, b, std::vector<std::uint32_t>(8, 1u)), mean_squared_error(a, b));
  EXPECT_THROW(covered_mean_squared_error(a, b, std::vector<std::uint32_t>(7)), Error);
}

TEST(Psnr, PicturesOfDifferentSizesCannotBeCompared) {
  EXPECT_THROW(mean_squared_error(flat({2, 3}, 0), flat({3, 2}, 0)), Error);
}

}  // namespace
}  // namespace stipple::test::measure_psnr
