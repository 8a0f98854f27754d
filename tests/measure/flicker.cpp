#include "render/measure/flicker.h"

#include <gtest/gtest.h>

#include <numeric>

#include "octree/core/error.h"
#include "tests/measure/made_pictures.h"

namespace stipple::test::measure_flicker {
namespace {

const glm::ivec2 kSize(50, 40);

std::vector<std::uint32_t> ids_from(std::uint32_t first) {
  std::vector<std::uint32_t> ids(static_cast<std::size_t>(kSize.x * kSize.y));
  std::iota(ids.begin(), ids.end(), first);
  return ids;
}

TEST(Flicker, IsZeroWhileTheErrorStaysHoweverLarge) {
  const Image wrong = flat_picture(kSize, 250);
  const Image right = made(kSize, mosaic);
  const std::vector<std::uint32_t> ids = ids_from(0);
  const Flicker still = flicker({wrong, right, ids}, {wrong, right, ids});
  EXPECT_EQ(still.mean, 0.0);
  EXPECT_EQ(still.still_pixels, 2000u);
}

TEST(Flicker, IsTheMeanChangeOfTheSignedError) {
  const Image reference = flat_picture(kSize, 100);
  const std::vector<std::uint32_t> ids = ids_from(0);
  for (const auto& [before, now] : {std::pair{100, 120}, {90, 120}, {255, 0}, {110, 100}}) {
    const Flicker change =
        flicker({flat_picture(kSize, before), reference, ids}, {flat_picture(kSize, now), reference, ids});
    EXPECT_DOUBLE_EQ(change.mean, std::abs(now - before));
  }
}

TEST(Flicker, FollowsTheErrorNotThePicture) {
  const std::vector<std::uint32_t> ids = ids_from(0);
  // The light changes, and the test with it: no flicker
  const Flicker lit = flicker({flat_picture(kSize, 60), flat_picture(kSize, 50), ids},
                              {flat_picture(kSize, 90), flat_picture(kSize, 80), ids});
  EXPECT_EQ(lit.mean, 0.0);
}

TEST(Flicker, LeavesOutWhatMoved) {
  const Image reference = flat_picture(kSize, 100);
  const std::vector<std::uint32_t> before = ids_from(0);
  std::vector<std::uint32_t> now = before;
  Image test = reference;
  // Moved pixels change most, still ones a little: of these, half
  for (std::size_t i = 0; i < now.size(); ++i) {
    if (i % 4 == 0) now[i] += 1'000'000;
    for (std::size_t c = 0; c < 3; ++c) test.rgb[3 * i + c] = i % 4 == 0 ? 255 : i % 4 == 1 ? 106 : 100;
  }
  const Flicker change = flicker({reference, reference, before}, {test, reference, now});
  EXPECT_EQ(change.still_pixels, 1500u);
  EXPECT_DOUBLE_EQ(change.mean, 2.0);
  const Flicker all_moved = flicker({reference, reference, before}, {test, reference, ids_from(5'000)});
  EXPECT_EQ(all_moved.still_pixels, 0u);
  EXPECT_EQ(all_moved.mean, 0.0);
}

TEST(Flicker, EmptyPixelsAreStill) {
  const std::vector<std::uint32_t> nothing(2000, kNoPoint);
  const Image reference = flat_picture(kSize, 128);
  EXPECT_EQ(flicker({reference, reference, nothing}, {flat_picture(kSize, 130), reference, nothing}).mean, 2.0);
}

TEST(Flicker, NeedsPicturesOfOneSizeAndAnIdForEachPixel) {
  const Image picture = flat_picture(kSize, 1);
  const Image other = flat_picture({40, 50}, 1);
  const std::vector<std::uint32_t> ids = ids_from(0);
  const std::vector<std::uint32_t> few(7);
  EXPECT_THROW(flicker({picture, picture, ids}, {other, other, ids}), Error);
  EXPECT_THROW(flicker({picture, other, ids}, {picture, picture, ids}), Error);
  EXPECT_THROW(flicker({picture, picture, ids}, {picture, picture, few}), Error);
}

}  // namespace
}  // namespace stipple::test::measure_flicker
