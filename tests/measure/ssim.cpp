#include "render/measure/ssim.h"

#include <gtest/gtest.h>

#include <map>

#include "octree/core/error.h"
#include "tests/measure/made_pictures.h"

namespace stipple::test::measure_ssim {
namespace {

// scikit-image 0.19.3 (Debian 12), on the bytes of made_pairs():
// structural_similarity(test, reference, gaussian_weights=True, sigma=1.5, use_sample_covariance=False, data_range=255,
//                       channel_axis=-1)
const std::map<std::string, double> kScikitImage = {{"noisy", 0.8403139},   {"holes", 0.6964195},
                                                    {"shifted", 0.7438418}, {"noise", 0.0414559},
                                                    {"bluer", 0.9865255},   {"black and white", 0.0001000}};

TEST(Ssim, IsThatOfScikitImage) {
  for (const PicturePair& pair : made_pairs())
    EXPECT_NEAR(ssim(pair.test, pair.reference).value(), kScikitImage.at(pair.name), 1e-5) << pair.name;
}

TEST(Ssim, OfIdenticalPicturesIsExactlyOne) {
  for (const PicturePair& pair : made_pairs()) EXPECT_EQ(ssim(pair.test, pair.test).value(), 1.0) << pair.name;
}

TEST(Ssim, IsSymmetric) {
  for (const PicturePair& pair : made_pairs())
    EXPECT_DOUBLE_EQ(ssim(pair.test, pair.reference).value(), ssim(pair.reference, pair.test).value()) << pair.name;
}

TEST(Ssim, OfFlatPicturesIsTheirLuminanceTermAlone) {
  const double c1 = 2.55 * 2.55;
  for (const auto& [a, b] : {std::pair{0, 255}, {100, 101}, {128, 140}, {7, 200}}) {
    const double expected = (2.0 * a * b + c1) / (static_cast<double>(a) * a + static_cast<double>(b) * b + c1);
    EXPECT_NEAR(ssim(flat_picture({30, 20}, a), flat_picture({30, 20}, b)).value(), expected, 5e-5);
  }
}

// One window, so that the formula can be written out.
TEST(Ssim, OfASingleWindowIsTheFormula) {
  const glm::ivec2 size(11, 11);
  const Image a = made(size, [](int x, int y, int c) { return dice(x, y, c, 256); });
  const Image b = made(size, [](int x, int y, int c) { return mosaic(x, y, c); });
  double expected = 0.0;
  for (std::size_t c = 0; c < 3; ++c) {
    double weights = 0, ma = 0, mb = 0, aa = 0, bb = 0, ab = 0;
    for (int i = 0; i < 121; ++i) {
      const int x = i % 11 - 5, y = i / 11 - 5;
      const double w = std::exp(-(x * x + y * y) / 4.5);
      const double va = a.rgb[3 * static_cast<std::size_t>(i) + c], vb = b.rgb[3 * static_cast<std::size_t>(i) + c];
      weights += w, ma += w * va, mb += w * vb, aa += w * va * va, bb += w * vb * vb, ab += w * va * vb;
    }
    ma /= weights, mb /= weights;
    const double c1 = 6.5025, c2 = 58.5225;
    expected += (2 * ma * mb + c1) * (2 * (ab / weights - ma * mb) + c2) / (ma * ma + mb * mb + c1) /
                (aa / weights - ma * ma + bb / weights - mb * mb + c2) / 3.0;
  }
  EXPECT_NEAR(ssim(a, b).value(), expected, 1e-5);
}

TEST(Ssim, NeedsAWholeWindowAndEqualSizes) {
  EXPECT_FALSE(ssim(flat_picture({10, 200}, 3), flat_picture({10, 200}, 3)).has_value());
  EXPECT_FALSE(ssim(flat_picture({200, 10}, 3), flat_picture({200, 10}, 4)).has_value());
  EXPECT_TRUE(ssim(flat_picture({11, 11}, 3), flat_picture({11, 11}, 3)).has_value());
  EXPECT_THROW(ssim(flat_picture({20, 30}, 0), flat_picture({30, 20}, 0)), Error);
}

}  // namespace
}  // namespace stipple::test::measure_ssim
