#include <gtest/gtest.h>

#include "octree/core/error.h"
#include "src/cli/cli.h"
#include "src/json/json.h"

namespace stipple::test::command_parse {
namespace {

// The message of the UsageError that `call` throws.
template <class Call>
std::string usage_error(const Call& call) {
  try {
    call();
  } catch (const UsageError& e) {
    return e.what();
  }
  return "no UsageError";
}

TEST(Parse, Size) {
  EXPECT_EQ(parse_size("--size", "1280x720"), glm::ivec2(1280, 720));
  EXPECT_EQ(parse_size("--size", "1x16384"), glm::ivec2(1, 16384));
  for (const char* text : {"", "x", "1280", "1280x", "x720", "0x5", "5x16385", "-1x5", "1.5x2", "1280X720", "1x2x3",
                           " 1x2", "99999999999x1"})
    EXPECT_THROW(parse_size("--size", text), UsageError) << text;
}

TEST(Parse, Vector) {
  EXPECT_EQ(parse_vector("--eye", "1.5,-2,3e4"), glm::dvec3(1.5, -2.0, 3e4));
  for (const char* text : {"", "1,2", "1,2,3,4", "1,,3", "1,2,", "a,b,c", "1, 2,3", "nan,0,0", "inf,0,0", "1e999,0,0"})
    EXPECT_THROW(parse_vector("--eye", text), UsageError) << text;
}

TEST(Parse, Color) {
  EXPECT_EQ(parse_color("--background", "8040fF"), 0x8040FFu);
  EXPECT_EQ(parse_color("--background", "#000001"), 1u);
  for (const char* text : {"", "#", "80808", "8080800", "80808g", "0x8080", "-80808", "grey"})
    EXPECT_THROW(parse_color("--background", text), UsageError) << text;
}

TEST(Parse, Positive) {
  EXPECT_EQ(parse_positive("--fov", "0.5"), 0.5);
  EXPECT_EQ(parse_positive("--fov", "6e1"), 60.0);
  for (const char* text : {"", "0", "-1", "nan", "inf", "1x", "1,5"})
    EXPECT_THROW(parse_positive("--fov", text), UsageError) << text;
}

TEST(Parse, Count) {
  EXPECT_EQ(parse_count("--points", "20M"), 20'000'000u);
  EXPECT_EQ(parse_count("--points", "1.5M"), 1'500'000u);
  EXPECT_EQ(parse_count("--points", "1.1m"), 1'100'000u);
  EXPECT_EQ(parse_count("--points", "100k"), 100'000u);
  EXPECT_EQ(parse_count("--points", "0.001k"), 1u);
  EXPECT_EQ(parse_count("--points", "2G"), 2'000'000'000u);
  EXPECT_EQ(parse_count("--points", "12345"), 12345u);
  EXPECT_EQ(parse_count("--points", "999999999999999"), 999'999'999'999'999u);
  for (const char* text : {"", "M", "0", "-5", "1.5", "1.2345k", "10 M", "10MM", "ten", "2000000G", "nan"})
    EXPECT_THROW(parse_count("--points", text), UsageError) << text;
}

TEST(Parse, EveryThousandthOfAMillionIsWhole) {
  for (std::uint64_t i = 1; i <= 100'000; ++i) {
    const std::string text = std::to_string(i / 1000) + "." + std::to_string(1000 + i % 1000).substr(1);
    EXPECT_EQ(parse_count("--points", text + "M"), i * 1000);
  }
}

TEST(Parse, MessagesNameOptionTextAndExpectation) {
  const std::string message = usage_error([] { parse_size("--size", "big"); });
  EXPECT_EQ(message, "--size: \"big\" is not WIDTHxHEIGHT in pixels, 1 to 16384 each, such as 1280x720");
  for (const std::string& other :
       {usage_error([] { parse_vector("--opt", "oops"); }), usage_error([] { parse_color("--opt", "oops"); }),
        usage_error([] { parse_positive("--opt", "oops"); }), usage_error([] { parse_count("--opt", "oops"); })}) {
    EXPECT_TRUE(other.starts_with("--opt: \"oops\" is not ")) << other;
    EXPECT_NE(other.find("such as"), std::string::npos) << other;
  }
}

TEST(Format, ThousandsAreSeparated) {
  EXPECT_EQ(with_thousands(0), "0");
  EXPECT_EQ(with_thousands(999), "999");
  EXPECT_EQ(with_thousands(1000), "1,000");
  EXPECT_EQ(with_thousands(1234567), "1,234,567");
  EXPECT_EQ(with_thousands(18446744073709551615u), "18,446,744,073,709,551,615");
}

TEST(Format, NumbersThatJsonLacksAreStrings) {
  EXPECT_EQ(json_of_any(1.5), Json(1.5));
  EXPECT_EQ(json_of_any(std::numeric_limits<double>::infinity()), Json("inf"));
  EXPECT_EQ(json_of_any(-std::numeric_limits<double>::infinity()), Json("-inf"));
  EXPECT_EQ(json_of(WorldBox{}), Json(nullptr));
}

}  // namespace
}  // namespace stipple::test::command_parse
