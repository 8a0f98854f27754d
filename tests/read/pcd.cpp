// PCD in every spelling.
#include <fmt/format.h>

#include <bit>

#include "octree/read/pcd/lzf.h"
#include "tests/read/read_fixture.h"

namespace stipple::test::read_pcd {
namespace {

using Doubles = std::vector<double>;
using Points = std::vector<glm::dvec3>;

class Pcd : public TableFiles {
 protected:
  static std::string header(const std::string& fields, const std::string& sizes, const std::string& types,
                            const std::string& counts, int points, const std::string& data) {
    return "# .PCD v.7 - Point Cloud Data file format\nVERSION .7\nFIELDS " + fields + "\nSIZE " + sizes + "\nTYPE " +
           types + "\nCOUNT " + counts + "\nWIDTH " + std::to_string(points) +
           "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + std::to_string(points) + "\nDATA " + data + "\n";
  }
  static std::string xyz(int points, const std::string& data) {
    return header("x y z", "4 4 4", "F F F", "1 1 1", points, data);
  }
};

// All literals.
std::string pack(const std::string& bytes) {
  std::string packed;
  for (std::size_t at = 0; at < bytes.size(); at += 32) {
    const std::string part = bytes.substr(at, 32);
    packed += static_cast<char>(part.size() - 1) + part;
  }
  return Binary().put(static_cast<std::uint32_t>(packed.size())).put(static_cast<std::uint32_t>(bytes.size())).bytes() +
         packed;
}

TEST_F(Pcd, AsciiIsReadWithAnySeparator) {
  for (const std::string s : {" ", "\t", ",", "  \t ", ", "}) {
    const Cloud cloud =
        load(xyz(2, "ascii") + "1" + s + "2" + s + "3\n4" + s + "5" + s + "6" + (s == " " ? " " : "") + "\n");
    EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(cloud.info.format, "PCD");
    EXPECT_EQ(cloud.info.version, "0.7");
    EXPECT_EQ(cloud.info.encoding, "ascii");
    EXPECT_EQ(cloud.info.warnings, Strings{});
  }
}

TEST_F(Pcd, HeaderLinesMayBeMissing) {
  const Points expected{{1, 2, 3}};
  EXPECT_EQ(worlds(load("VERSION 0.5\nFIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nPOINTS 1\nDATA ascii\n1 2 3\n")), expected);
  EXPECT_EQ(worlds(load("FIELDS x y z\nWIDTH 1\nHEIGHT 1\nDATA ascii\n1 2 3\n")), expected);
  EXPECT_EQ(worlds(load("# a\n\nCOLUMNS X Y Z\r\nWIDTH 1\r\nDATA ascii\r\n1 2 3\r\n")), expected);
}

TEST_F(Pcd, EveryTypeIsReadFromEveryEncoding) {
  const struct {
    std::string letter;
    std::string size;
    ScalarType type;
  } types[] = {{"U", "1", ScalarType::u8},  {"I", "1", ScalarType::i8},  {"U", "2", ScalarType::u16},
               {"I", "2", ScalarType::i16}, {"U", "4", ScalarType::u32}, {"I", "4", ScalarType::i32},
               {"U", "8", ScalarType::u64}, {"I", "8", ScalarType::i64}, {"F", "4", ScalarType::f32},
               {"F", "8", ScalarType::f64}};
  for (const auto& [letter, size, type] : types) {
    // clang 14 lets no lambda capture names of a structured binding
    const std::string letters = letter + " F F " + letter, sizes = size + " 8 4 " + size;
    const auto with = [&](const std::string& data) {
      return header("value x y z", sizes, letters, "1 1 1 1", 2, data);
    };
    Binary rows, columns;
    for (const double v : {5.0, 100.0}) rows.put_as(type, v).put(0.125).put(-2.5f).put_as(type, v + 1);
    columns.put_as(type, 5).put_as(type, 100).put(0.125).put(0.125).put(-2.5f).put(-2.5f);
    columns.put_as(type, 6).put_as(type, 101);
    for (const std::string& content : {with("binary") + rows.bytes(), with("binary_compressed") + pack(columns.bytes()),
                                       with("ascii") + "5 0.125 -2.5 6\n100 1.25e-1 -2.5 101\n"}) {
      const Cloud cloud = load(content);
      EXPECT_EQ(worlds(cloud), (Points{{0.125, -2.5, 6}, {0.125, -2.5, 101}}));
      EXPECT_EQ(values(cloud, "value"), (Doubles{5, 100}));
      EXPECT_EQ(cloud.info.schema.at(0), (Attribute{"value", type}));
    }
  }
}

TEST_F(Pcd, PackedColorsAreTakenApart) {
  const std::uint32_t color = 0xC0010203u;
  const Doubles expected{257, 514, 771};
  for (const std::string name : {"rgb", "rgba"})
    for (const std::string letter : {"F", "U", "I"}) {
      const Cloud cloud = load(header("x y z " + name, "4 4 4 4", "F F F " + letter, "1 1 1 1", 1, "binary") +
                               Binary().put(1.f).put(2.f).put(3.f).put(color).bytes());
      EXPECT_EQ(values(cloud, "rgb"), expected);
      EXPECT_EQ(values(cloud, "alpha"), name == "rgba" ? Doubles{0xC0} : Doubles{});
    }
  EXPECT_EQ(values(load(header("x y z rgb", "4 4 4 4", "F F F U", "1 1 1 1", 1, "ascii") + "1 2 3 66051\n"), "rgb"),
            expected);
  // A float whose bits are the colour
  const float bits = std::bit_cast<float>(0x00FF8001u);
  EXPECT_EQ(values(load(header("x y z rgb", "4 4 4 4", "F F F F", "1 1 1 1", 1, "ascii") +
                        fmt::format("1 2 3 {:.9e}\n", bits)),
                   "rgb"),
            (Doubles{65535, 128 * 257, 257}));
  EXPECT_EQ(values(load(header("x y z rgb", "4 4 4 1", "F F F U", "1 1 1 3", 1, "ascii") + "1 2 3 1 2 3\n"), "rgb"),
            expected);
}

TEST_F(Pcd, PaddingAndCountsAreKept) {
  const std::string fields = "_ x y _ z label normal_x hist _";
  const auto with = [&](const std::string& data) {
    return header(fields, "1 4 4 3 4 4 4 2 4", "U F F U F U F I F", "4 1 1 1 1 1 1 3 0", 2, data);
  };
  Binary rows, columns;
  const auto padding = [](Binary& to, int bytes) {
    for (int i = 0; i < bytes; ++i) to.put(std::uint8_t{0xEE});
  };
  for (int i = 0; i < 2; ++i) {
    padding(rows, 4);
    rows.put(1.f + static_cast<float>(i)).put(2.f);
    padding(rows, 3);
    rows.put(3.f).put(7u).put(0.5f).put(std::int16_t{-1}).put(std::int16_t{2}).put(static_cast<std::int16_t>(i));
  }
  padding(columns, 8);
  columns.put(1.f).put(2.f).put(2.f).put(2.f);
  padding(columns, 6);
  columns.put(3.f).put(3.f).put(7u).put(7u).put(.5f).put(.5f);
  for (const int v : {-1, 2, 0, -1, 2, 1}) columns.put(static_cast<std::int16_t>(v));
  for (const std::string& content : {with("binary") + rows.bytes(), with("binary_compressed") + pack(columns.bytes()),
                                     with("ascii") + "9 9 9 9 1 2 9 3 7 .5 -1 2 0\n9 9 9 9 2 2 9 3 7 .5 -1 2 1\n"}) {
    const Cloud cloud = load(content);
    EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {2, 2, 3}}));
    EXPECT_EQ(names_of(cloud), (Strings{"label", "nx", "hist"}));
    EXPECT_EQ(cloud.info.schema.at(2), (Attribute{"hist", ScalarType::i16, 3}));
    EXPECT_EQ(values(cloud, "hist"), (Doubles{-1, 2, 0, -1, 2, 1}));
  }
}

TEST_F(Pcd, OrganisedCloudsLoseTheirHoles) {
  const std::string content =
      "FIELDS x y z\nSIZE 4 4 4\nTYPE F F F\nCOUNT 1 1 1\nWIDTH 2\nHEIGHT 2\nPOINTS 4\nDATA ascii\n"
      "nan nan nan\n1 2 3\n-nan NaN nan\n4 5 6\n";
  const Cloud cloud = load(content);
  EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(cloud.info.dropped_points, 2u);
}

TEST_F(Pcd, WidthTimesHeightThatIsNotPointsIsAWarning) {
  const auto source = open("FIELDS x y z\nWIDTH 3\nHEIGHT 1\nPOINTS 2\nDATA ascii\n1 2 3\n4 5 6\n");
  EXPECT_EQ(source->info().point_count, 2u);
  EXPECT_TRUE(one_that_contains(source->info().warnings, "WIDTH 3 times HEIGHT 1 is not POINTS 2"));
}

TEST_F(Pcd, FaultsNameBytesAndLines) {
  EXPECT_TRUE(contains(error("VERSION 0.7\nFIELDS x y z\n"), "at byte 25: the header ends here"));
  EXPECT_TRUE(contains(error("VERSION 0.7\nPOINTS 1\nDATA ascii\n"), "no line \"FIELDS\""));
  EXPECT_TRUE(contains(error("FIELDS x y z\nDATA ascii\n"), "neither POINTS nor WIDTH"));
  EXPECT_TRUE(contains(error("FIELDS x y z\nPOINTS few\nDATA ascii\n"), "at byte 13: POINTS has no whole number"));
  EXPECT_TRUE(contains(error("FIELDS x y z\nSIZE 4 4\nPOINTS 1\nDATA ascii\n"), "SIZE has 2 values, and FIELDS has 3"));
  EXPECT_TRUE(contains(error("FIELDS x y z\nSIZE 4 4 3\nPOINTS 1\nDATA ascii\n"), "field \"z\" has type F and size 3"));
  EXPECT_TRUE(contains(error("FIELDS x y z\nPOINTS 1\nDATA zipped\n"), "none of ascii, binary and binary_compressed"));
  EXPECT_TRUE(contains(error("FIELDS x y z\nNUMBER 1\n"), "a line that is none of"));
  EXPECT_TRUE(contains(error("FIELDS a b c\nPOINTS 1\nDATA ascii\n1 2 3\n"), "no x; they have: a b c"));
  EXPECT_TRUE(contains(error(xyz(2, "ascii") + "1 2 3\n4 5\n"), "line 13: has 2 values, and 3 were expected"));
  EXPECT_TRUE(contains(error(xyz(3, "ascii") + "1 2 3\n4 5 6\n"), "line 14: the file ends here, with 2 of the 3"));
  EXPECT_TRUE(contains(error(xyz(1, "ascii") + "1,,3\n"), "\"\" was found where the value of \"y\""));
  EXPECT_TRUE(contains(error(xyz(3, "binary") + std::string(35, 'a')), "enough for 2"));
  EXPECT_TRUE(contains(error("FIELDS x y z\nCOUNT 1 1 99999999\nPOINTS 1\nDATA ascii\n"), "longer than"));
}

TEST_F(Pcd, CountsBeyondTheFileAreErrorsBeforeAnythingIsAllocated) {
  for (const char* count : {"1000000000000", "18446744073709551615"}) {
    const std::string start = "FIELDS x y z\nPOINTS " + std::string(count) + "\nDATA ";
    EXPECT_TRUE(contains(error(start + "binary\n" + std::string(24, 'a')), "at byte 13: the header states"));
    EXPECT_TRUE(contains(error(start + "binary_compressed\n" + std::string(24, 'a')), "at byte "));
    EXPECT_TRUE(contains(error(start + "ascii\n1 2 3\n"), "with 1 of the " + std::string(count)));
  }
  // Sizes that agree with the header, but not with what LZF can hold
  EXPECT_TRUE(contains(error("FIELDS x y z\nPOINTS 100000000\nDATA binary_compressed\n" +
                             Binary().put(8u).put(1'200'000'000u).put(0.0).bytes()),
                       "are said to be packed into 8"));
}

TEST(Lzf, CopiesOfEveryLengthAndDistanceComeOut) {
  const auto decode = [](const std::string& in, std::size_t size) {
    std::string out(size, '?');
    const LzfResult result = decode_lzf(std::as_bytes(std::span(in)), std::as_writable_bytes(std::span(out)));
    return result.good ? out : "fault at " + std::to_string(result.read);
  };
  using namespace std::string_literals;
  EXPECT_EQ(decode("\x02"
                   "abc"s,
                   3),
            "abc");
  EXPECT_EQ(decode("\x02"
                   "abc\x20\x02"s,
                   6),
            "abcabc");
  EXPECT_EQ(decode("\x00"
                   "a\xE0\x00\x00"s,
                   10),
            std::string(10, 'a'));  // 9 bytes from 1 back, into itself
  EXPECT_EQ(decode("\x00"
                   "a\xE0\xFF\x00"s,
                   265),
            std::string(265, 'a'));  // the longest
  std::string far(8192, 'x');
  far[0] = 'F';
  far[1] = 'G';
  std::string packed;
  for (std::size_t at = 0; at < far.size(); at += 32) packed += '\x1F' + far.substr(at, 32);
  EXPECT_EQ(decode(packed + "\x3F\xFF"s, 8195), far + "FGx");  // the farthest
  EXPECT_EQ(decode("\x02"
                   "ab"s,
                   3),
            "fault at 0");
  EXPECT_EQ(decode("\x00"
                   "a\x20\x01"s,
                   5),
            "fault at 2");  // before the begin
  EXPECT_EQ(decode("\x00"
                   "a\xE0\x05"s,
                   5),
            "fault at 2");
  EXPECT_EQ(decode("\x00"
                   "a\x20\x00"s,
                   3),
            "fault at 2");  // more than fits
  EXPECT_EQ(decode("\x00"
                   "a"s,
                   2),
            "fault at 2");  // too little
  EXPECT_EQ(decode("", 0), "");
}

}  // namespace
}  // namespace stipple::test::read_pcd
