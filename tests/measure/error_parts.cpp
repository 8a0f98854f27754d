#include "render/measure/error_parts.h"

#include <gtest/gtest.h>

#include "octree/core/error.h"
#include "render/measure/psnr.h"

namespace stipple::test::measure_error_parts {
namespace {

using Ids = std::vector<std::uint32_t>;

Image grey(const std::vector<std::uint8_t>& levels) {
  Image image{{static_cast<int>(levels.size()), 1}, {}};
  for (const std::uint8_t level : levels) image.rgb.insert(image.rgb.end(), 3, level);
  return image;
}

TEST(ErrorPartsTest, EachPixelCountsForThePartThatMadeIt) {
  const Image reference = grey({100, 100, 100, 100, 100});
  const Image test = grey({101, 110, 120, 130, 100});
  const Ids brute_force{1, 2, 3, kNoPoint, kNoPoint};
  const Ids ids{1, 9, kNoPoint, 8, kNoPoint};
  ShownPoints shown;
  shown.add(Ids{3, kNoPoint});
  const ErrorParts parts = error_parts(test, ids, reference, brute_force, shown);
  EXPECT_DOUBLE_EQ(parts.rounding, 1.0 / 5);           // pixel 0: the right point
  EXPECT_DOUBLE_EQ(parts.selection, 100.0 / 5);        // pixel 1: point 2 was not shown yet
  EXPECT_DOUBLE_EQ(parts.carry, (400.0 + 900.0) / 5);  // pixel 2: point 3 was; pixel 3: nothing is there
  EXPECT_DOUBLE_EQ(parts.rounding + parts.selection + parts.carry, mean_squared_error(test, reference));
}

TEST(ErrorPartsTest, APictureEqualToBruteForceHasNothingButRounding) {
  const Image reference = grey({10, 20});
  const Image test = grey({12, 20});
  ShownPoints shown;
  shown.add(Ids{4});
  const ErrorParts parts = error_parts(test, Ids{4, 5}, reference, Ids{4, 5}, shown);
  EXPECT_DOUBLE_EQ(parts.rounding, 2.0);
  EXPECT_EQ(parts.selection + parts.carry, 0.0);
}

TEST(ErrorPartsTest, SizesMustAgree) {
  EXPECT_THROW(error_parts(grey({1}), Ids{1}, grey({1, 2}), Ids{1, 2}, {}), Error);
  EXPECT_THROW(error_parts(grey({1, 2}), Ids{1}, grey({1, 2}), Ids{1, 2}, {}), Error);
}

TEST(ShownPointsTest, HoldsWhatWasAddedAndNothingElse) {
  ShownPoints shown;
  EXPECT_FALSE(shown.contains(0));
  shown.add(Ids{0, 63, 64, 1000, kNoPoint});
  for (const std::uint32_t id : Ids{0, 63, 64, 1000}) EXPECT_TRUE(shown.contains(id)) << id;
  for (const std::uint32_t id : Ids{1, 62, 65, 999, 1001, 1u << 30, kNoPoint}) EXPECT_FALSE(shown.contains(id)) << id;
  shown.clear();
  EXPECT_FALSE(shown.contains(64));
}

}  // namespace
}  // namespace stipple::test::measure_error_parts
