// Plain text: separators, names, guesses.
#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <random>

#include "octree/read/text/number.h"
#include "tests/read/read_fixture.h"

namespace stipple::test::read_text {
namespace {

using Doubles = std::vector<double>;
using Points = std::vector<glm::dvec3>;

class Text : public TableFiles {
 protected:
  Strings columns(const std::string& content) const { return names_of(load(content)); }
};

TEST_F(Text, EverySeparatorIsRead) {
  for (const std::string s : {" ", "\t", ",", ";", ", ", " ; ", "   "})
    for (const std::string end : {"\n", "\r\n", "\r"}) {
      const Cloud cloud = load("1" + s + "2" + s + "3" + end + "4" + s + "5" + s + "6.5" + end);
      EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {4, 5, 6.5}}));
      EXPECT_EQ(cloud.info.format, "text");
      EXPECT_TRUE(contains(cloud.info.encoding, "columns x y z"));
      EXPECT_TRUE(contains(cloud.info.encoding, "guessed from the numbers"));
      EXPECT_EQ(cloud.info.warnings, Strings{});
    }
}

TEST_F(Text, CommentsAndEmptyLinesAreSkipped) {
  EXPECT_EQ(worlds(load("// made by hand\n\n1 2 3\n# between\n  // and again\n4 5 6\n\n")),
            (Points{{1, 2, 3}, {4, 5, 6}}));
}

TEST_F(Text, ALineOfNamesNamesTheColumns) {
  for (const std::string names : {"x y z Intensity R G B label", "//X Y Z intensity Red Green Blue label",
                                  "# \"x\" \"y\" \"z\" scalar_Intensity r g b label"}) {
    const Cloud cloud = load(names + "\n1 2 3 500 255 0 1 -3\n4 5 6 600 0 0 0 70000\n");
    EXPECT_EQ(names_of(cloud), (Strings{"rgb", "intensity", "label"})) << names;
    EXPECT_EQ(values(cloud, "rgb"), (Doubles{65535, 0, 257, 0, 0, 0}));
    EXPECT_EQ(values(cloud, "intensity"), (Doubles{500, 600}));
    EXPECT_EQ(cloud.info.schema[1].type, ScalarType::u16);
    EXPECT_EQ(cloud.info.schema[2].type, ScalarType::i32);
    EXPECT_TRUE(contains(cloud.info.encoding, "named by line 1"));
  }
  EXPECT_EQ(worlds(load("label;Z;Y;X\n9;3;2;1\n")), (Points{{1, 2, 3}}));
}

TEST_F(Text, AnotherNumberOfNamesIsNoNameLine) {
  const Cloud cloud = load("# x y of the scanner\n1 2 3 4\n");
  EXPECT_EQ(names_of(cloud), Strings{"intensity"});
  EXPECT_TRUE(contains(cloud.info.encoding, "guessed"));
}

TEST_F(Text, ColumnsAreGuessedFromTheirNumbers) {
  EXPECT_EQ(columns("1 2 3 0.5\n"), Strings{"intensity"});
  EXPECT_EQ(columns("1 2 3 255 0 9\n"), Strings{"rgb"});
  EXPECT_EQ(columns("1 2 3 0.5 0.25 1\n"), Strings{"rgb"});
  EXPECT_EQ(columns("1 2 3 0.6 0 0.8\n1 2 3 0 -1 0\n"), (Strings{"nx", "ny", "nz"}));
  EXPECT_EQ(columns("1 2 3 -1000 255 0 9\n"), (Strings{"rgb", "intensity"}));
  EXPECT_EQ(columns("1 2 3 100 255 0 9\n"), (Strings{"rgb", "intensity"}));
  EXPECT_EQ(columns("1 2 3 255 0 9 5000\n"), (Strings{"rgb", "intensity"}));
  EXPECT_EQ(columns("1 2 3 255 0 9 0.6 0 0.8\n"), (Strings{"rgb", "nx", "ny", "nz"}));
  EXPECT_EQ(columns("1 2 3 0.6 0 0.8 255 0 9\n"), (Strings{"rgb", "nx", "ny", "nz"}));
  EXPECT_EQ(columns("1 2 3 77 255 0 9 0.6 0 -0.8\n"), (Strings{"rgb", "intensity", "nx", "ny", "nz"}));
  EXPECT_EQ(columns("1 2 3 4.5 1000\n"), (Strings{"column 4", "intensity"}));
  EXPECT_EQ(values(load("1 2 3 100 255 0 9\n"), "intensity"), Doubles{100});
  EXPECT_TRUE(contains(open("1 2 3 4.5 1000\n")->info().encoding, "columns x y z ? intensity"));
}

TEST_F(Text, OneRowThatFitsNoColorDecidesForAll) {
  std::string rows;
  for (int i = 0; i < 100'000; ++i) rows += "1 2 3 255 0 9\n";
  EXPECT_EQ(columns(rows), Strings{"rgb"});
  EXPECT_NE(columns(rows + "1 2 3 256 0 9\n"), Strings{"rgb"});
}

TEST_F(Text, ACountBeforeThePointsIsHeldAgainstThem) {
  const Cloud cloud = load("2\n1 2 3 -7 255 0 0\n4 5 6 -8 0 255 0\n");
  EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.info.warnings, Strings{});
  EXPECT_TRUE(one_that_contains(open("3\n1 2 3\n4 5 6\n")->info().warnings,
                                "states 3 points before the first, and has 2; it may be cut off"));
  EXPECT_TRUE(contains(error("2\n3\n0 0 0\n1 0 0\n"), "PTX"));
}

TEST_F(Text, FaultsNameTheLine) {
  EXPECT_TRUE(
      contains(error("1 2 3\n# c\n4 five 6\n"), "line 3: \"five\" was found where a number was expected, as column 2"));
  EXPECT_TRUE(contains(error("1 2 3\n4 5\n"), "line 2: has 2 numbers, and 3 were expected, as in line 1"));
  EXPECT_TRUE(contains(error("1 2 3\n4 5 6 7\n"), "line 2: has 4 numbers"));
  EXPECT_TRUE(contains(error("1,2,3\n4,,6\n"), "line 2: \"\" was found"));
  EXPECT_TRUE(contains(error("1 2 3\n4 5 6x\n"), "\"6x\""));
  EXPECT_TRUE(contains(error(std::string("1 2 3\n4 5 6\0\n", 13)), "no point cloud that is read"));
  EXPECT_TRUE(contains(error("1 2\n3 4\n"), "no point cloud that is read"));
  EXPECT_TRUE(contains(error("a b c\nd e f\n1 2 3\n"), "no point cloud that is read"));
  EXPECT_TRUE(contains(error(std::string(1, ' ')), "no point cloud that is read"));
  EXPECT_TRUE(contains(error(""), "the file is empty"));
}

TEST_F(Text, LinesThatAreFarTooLongAreAnError) {
  EXPECT_TRUE(contains(error("1 2 3\n" + std::string(20'000'000, '1')), "a line of more than"));
}

TEST_F(Text, LinesAcrossTheBordersOfChunksAreReadOnce) {
  // Rows of many lengths, so that borders fall on every place of a row
  std::string content;
  constexpr int kRows = 80'000;
  for (int i = 0; i < kRows; ++i)
    content += fmt::format("{} {:.{}f} {}\n{}", i, 0.5, 1 + i % 30, -i, i % 7 == 0 ? "# a comment\n\n" : "");
  const Cloud cloud = load(content);
  ASSERT_GT(content.size(), std::size_t{2} << 20);
  ASSERT_EQ(cloud.size(), static_cast<std::size_t>(kRows));
  for (int i = 0; i < kRows; ++i)
    ASSERT_EQ(cloud.info.grid.world_from_grid(cloud.positions[static_cast<std::size_t>(i)]), glm::dvec3(i, 0.5, -i));
}

TEST_F(Text, AnErrorFarIntoTheFileNamesItsLine) {
  std::string content;
  for (int i = 0; i < 300'000; ++i) content += "1 2 3\n";
  EXPECT_TRUE(contains(error(content + "1 2 x\n"), "line 300001: \"x\""));
}

TEST(Number, EveryDoubleComesBackFromItsText) {
  std::mt19937_64 random(3);
  for (int i = 0; i < 200'000; ++i) {
    double value = std::bit_cast<double>(random());
    if (i % 2 == 0) value = std::ldexp(static_cast<double>(random() >> 20), static_cast<int>(random() % 60) - 50);
    if (!std::isfinite(value)) continue;
    for (const std::string& text :
         {fmt::format("{}", value), fmt::format("{:.17g}", value), fmt::format("{:+.20e}", value)}) {
      double read = 0.0;
      ASSERT_EQ(parse_number(text.data(), text.data() + text.size(), read), text.data() + text.size()) << text;
      ASSERT_EQ(std::bit_cast<std::uint64_t>(read), std::bit_cast<std::uint64_t>(value)) << text;
    }
  }
}

TEST(Number, SpellingsOfWhatIsNoNumberAreKnown) {
  const auto read = [](std::string_view text) {
    double value = 7.0;
    const char* const end = parse_number(text.data(), text.data() + text.size(), value);
    return end == text.data() + text.size() ? value : 7.0;
  };
  for (const char* nan : {"nan", "NaN", "-nan", "NAN", "nan(ind)", "-nan(ind)", "1.#QNAN", "-1.#IND", "1.#QNAN0"})
    EXPECT_TRUE(std::isnan(read(nan))) << nan;
  for (const char* inf : {"inf", "+Inf", "Infinity", "1.#INF", "1e999", "9e99999999999"})
    EXPECT_EQ(read(inf), INFINITY) << inf;
  EXPECT_EQ(read("-inf"), -INFINITY);
  EXPECT_EQ(read("1e-999"), 0.0);
  EXPECT_EQ(read("000000000000000000000000012.5"), 12.5);
  EXPECT_EQ(read("0.00000000000000000000000000000125"), 1.25e-30);
  EXPECT_EQ(read("5."), 5.0);
  EXPECT_EQ(read("-.5"), -0.5);
  for (const char* none : {"", "-", "+", ".", "e5", "--1", "in", "abc", "0x10", "1e", "1e+", "1,5"})
    EXPECT_EQ(read(none), 7.0) << none;
}

TEST(Number, WholeNumbersAreHeldToTheirType) {
  const auto fits = [](ScalarType type, std::string_view text) {
    std::byte out[8];
    return parse_as(type, text.data(), text.data() + text.size(), out) == text.data() + text.size();
  };
  EXPECT_TRUE(fits(ScalarType::u8, "255"));
  EXPECT_TRUE(fits(ScalarType::u8, "-1"));
  EXPECT_TRUE(fits(ScalarType::i8, "255"));
  EXPECT_FALSE(fits(ScalarType::u8, "256"));
  EXPECT_FALSE(fits(ScalarType::i8, "-129"));
  EXPECT_FALSE(fits(ScalarType::u8, "nan"));
  EXPECT_TRUE(fits(ScalarType::u32, "4294967295"));
  EXPECT_FALSE(fits(ScalarType::u32, "-1"));
  EXPECT_FALSE(fits(ScalarType::i32, "2147483648"));
  EXPECT_TRUE(fits(ScalarType::i64, "-9223372036854775808"));
  EXPECT_TRUE(fits(ScalarType::u64, "18446744073709551615"));
  EXPECT_FALSE(fits(ScalarType::u64, "-1"));
  EXPECT_TRUE(fits(ScalarType::u64, "1e3"));
  EXPECT_FALSE(fits(ScalarType::u64, "1.5"));
}

}  // namespace
}  // namespace stipple::test::read_text
