#include "src/report/pictures.h"

#include <gtest/gtest.h>

namespace stipple::test::report_pictures {
namespace {

TEST(DataUri, EncodesEveryRemainder) {
  const std::string start = "data:image/png;base64,";
  // RFC 4648, section 10
  EXPECT_EQ(data_uri(""), start);
  EXPECT_EQ(data_uri("f"), start + "Zg==");
  EXPECT_EQ(data_uri("fo"), start + "Zm8=");
  EXPECT_EQ(data_uri("foo"), start + "Zm9v");
  EXPECT_EQ(data_uri("foobar"), start + "Zm9vYmFy");
  EXPECT_EQ(data_uri("\xFF\xFE\xFD"), start + "//79");
}

TEST(Shrunk, IsTheRoundedMeanAndDropsWhatIsLeftOver) {
  Image image{{5, 3}, std::vector<std::uint8_t>(45, 9)};
  const auto set = [&](std::size_t x, std::size_t y, std::uint8_t level) { image.rgb[3 * (y * 5 + x)] = level; };
  set(0, 0, 10);
  set(1, 0, 20);
  set(0, 1, 30);
  set(1, 1, 42);
  const Image small = shrunk(image, 2);
  EXPECT_EQ(small.size, glm::ivec2(2, 1));
  EXPECT_EQ(small.rgb, (std::vector<std::uint8_t>{26, 9, 9, 9, 9, 9}));
  EXPECT_EQ(shrunk(image, 1).rgb, image.rgb);
}

}  // namespace
}  // namespace stipple::test::report_pictures
