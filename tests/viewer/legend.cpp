#include "src/viewer/legend.h"

#include <gtest/gtest.h>

namespace stipple::test::viewer_legend {
namespace {

TEST(Legend, EndsHaveAsManyDigitsAsTellThemApart) {
  using Ends = std::array<std::string, 2>;
  EXPECT_EQ(range_text(4.9123, 59.912), (Ends{"4.9", "59.9"}));
  EXPECT_EQ(range_text(0, 65535), (Ends{"0", "65535"}));
  EXPECT_EQ(range_text(245378901.25, 245378902.5), (Ends{"245378901.25", "245378902.50"})) << "GPS time";
  EXPECT_EQ(range_text(3, 3), (Ends{"3", "3"}));
}

TEST(Legend, StepsAreTheColoursOfTheirValues) {
  const ColorMap map{.attribute = "return number", .low = 1.0, .high = 3.0, .ramp = Ramp::height_field};
  EXPECT_EQ(legend_colors(map, 3), (std::vector<std::uint32_t>{0xFFFF0000u, 0xFF00FFFFu, 0xFF0000FFu}));
  EXPECT_TRUE(legend_colors({.attribute = "rgb", .kind = ColorMap::Kind::rgb8}, 3).empty());
}

}  // namespace
}  // namespace stipple::test::viewer_legend
