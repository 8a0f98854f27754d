#include "render/measure/flip.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <map>

#include "octree/core/error.h"
#include "render/measure/lab.h"
#include "render/measure/ssim.h"
#include "tests/measure/made_pictures.h"

namespace stipple::test::measure_flip {
namespace {

// The mean of the error map that the authors' C++ implementation gives (FLIP.h, version 1.6, without CUDA, 67 pixels
// per degree) for the bytes of made_pairs() / 255, made linear by its own sRGBToLinearRGB.
const std::map<std::string, double> kAuthors = {{"noisy", 0.102270},   {"holes", 0.232752},
                                                {"shifted", 0.175841}, {"noise", 0.453367},
                                                {"bluer", 0.220077},   {"black and white", 0.967392}};

TEST(Flip, IsThatOfItsAuthors) {
  for (const PicturePair& pair : made_pairs())
    EXPECT_NEAR(flip(pair.test, pair.reference), kAuthors.at(pair.name), 1e-4) << pair.name;
}

TEST(Flip, OfIdenticalPicturesIsZero) {
  for (const PicturePair& pair : made_pairs()) EXPECT_EQ(flip(pair.test, pair.test), 0.0) << pair.name;
}

TEST(Flip, IsSymmetric) {
  for (const PicturePair& pair : made_pairs())
    EXPECT_DOUBLE_EQ(flip(pair.test, pair.reference), flip(pair.reference, pair.test)) << pair.name;
}

// No edges: the error is that of the colours, L* against L*, whatever the size. What floats leave of an edge, about
// 1e-8, counts by its square root.
TEST(Flip, OfFlatGreysIsTheDistanceOfTheirLightness) {
  const auto lightness = [](int grey) {
    return lab_of(glm::vec3(linear_of_srgb_table()[static_cast<std::size_t>(grey)])).x;
  };
  const glm::mat3 xyz = relative_xyz_from_rgb();
  const double largest = std::pow(hyab(hunt_adjusted(lab_of(xyz[1])), hunt_adjusted(lab_of(xyz[2]))), 0.7);
  for (const auto& [a, b] : {std::pair{100, 110}, {0, 30}, {200, 255}}) {
    const double error = std::pow(lightness(b) - lightness(a), 0.7);
    ASSERT_LT(error, 0.4 * largest);
    for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 50), glm::ivec2(60, 97)})
      EXPECT_NEAR(flip(flat_picture(size, a), flat_picture(size, b)), 0.95 * error / (0.4 * largest), 3e-4) << a;
  }
}

TEST(Flip, GrowsWithTheDifference) {
  double before = 0.0;
  for (int grey = 101; grey < 256; ++grey) {
    const double now = flip(flat_picture({5, 5}, grey), flat_picture({5, 5}, 100));
    EXPECT_GT(now, before);
    before = now;
  }
}

// The picture is cut into bands: none of them may show.
TEST(Flip, DoesNotDependOnWhereTheDifferenceIs) {
  const glm::ivec2 size(90, 150);
  const auto with_dot = [&](int at) {
    return flip(made(size, [at](int x, int y, int) { return x == 45 && y == at ? 255 : 60; }), flat_picture(size, 60));
  };
  const double expected = with_dot(75);
  EXPECT_GT(expected, 0.0);
  for (int y = 25; y < 125; ++y) EXPECT_NEAR(with_dot(y), expected, 1e-7) << y;
}

TEST(Flip, AndSsimDoNotDependOnTheNumberOfThreads) {
  const Image a = made({200, 300}, mosaic);
  const Image b = made({200, 300}, [](int x, int y, int c) { return mosaic(x, y, c) + dice(x, y, c, 30); });
  const double flip_of_all = flip(a, b);
  const double ssim_of_all = ssim(a, b).value();
  const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(flip(a, b), flip_of_all);
  EXPECT_EQ(ssim(a, b).value(), ssim_of_all);
}

TEST(Flip, PicturesOfDifferentSizesCannotBeCompared) {
  EXPECT_THROW(flip(flat_picture({2, 3}, 0), flat_picture({3, 2}, 0)), Error);
}

TEST(Lab, CubeRootsAreRight) {
  for (int i = 1; i <= 100'000; ++i) {
    const float t = static_cast<float>(i) * 1e-5f;
    EXPECT_NEAR(cube_root(t), std::cbrt(static_cast<double>(t)), 3e-7);
  }
}

TEST(Lab, WhiteAndBlackAreTheEndsOfLightness) {
  EXPECT_NEAR(lab_of(glm::vec3(1.0f)).x, 100.0f, 1e-4f);
  EXPECT_NEAR(lab_of(glm::vec3(0.0f)).x, 0.0f, 1e-4f);
  // sRGB red: the published L*a*b* of D65
  const glm::vec3 red = lab_of(relative_xyz_from_rgb()[0]);
  EXPECT_NEAR(red.x, 53.24f, 0.01f);
  EXPECT_NEAR(red.y, 80.09f, 0.01f);
  EXPECT_NEAR(red.z, 67.20f, 0.01f);
}

}  // namespace
}  // namespace stipple::test::measure_flip
