// PLY in every spelling.
#include <cmath>
#include <limits>

#include "tests/read/read_fixture.h"

namespace stipple::test::read_ply {
namespace {

using Doubles = std::vector<double>;
using Points = std::vector<glm::dvec3>;

class Ply : public TableFiles {
 protected:
  static std::string header(const std::string& format, const std::string& declarations) {
    return "ply\nformat " + format + " 1.0\n" + declarations + "end_header\n";
  }
  static std::string ascii(const std::string& declarations, const std::string& rows) {
    return header("ascii", declarations) + rows;
  }
  static std::string vertex(int count, const std::string& more = "") {
    return fmt::format("element vertex {}", count) + "\nproperty float x\nproperty float y\nproperty float z\n" + more;
  }
};

TEST_F(Ply, EverySpellingOfEveryTypeIsReadInBothByteOrders) {
  const std::pair<const char*, ScalarType> spellings[] = {
      {"char", ScalarType::i8},     {"int8", ScalarType::i8},     {"uchar", ScalarType::u8},
      {"uint8", ScalarType::u8},    {"short", ScalarType::i16},   {"int16", ScalarType::i16},
      {"ushort", ScalarType::u16},  {"uint16", ScalarType::u16},  {"int", ScalarType::i32},
      {"int32", ScalarType::i32},   {"uint", ScalarType::u32},    {"uint32", ScalarType::u32},
      {"float", ScalarType::f32},   {"float32", ScalarType::f32}, {"double", ScalarType::f64},
      {"float64", ScalarType::f64}, {"bool", ScalarType::u8}};
  for (const auto& [name, type] : spellings)
    for (const bool big : {false, true}) {
      SCOPED_TRACE(std::string(name) + (big ? " big" : " little"));
      std::string content = header(big ? "binary_big_endian" : "binary_little_endian",
                                   "element vertex 2\nproperty " + std::string(name) +
                                       " value\nproperty double x\nproperty " + name + " y\nproperty float z\n");
      Binary rows(big);
      for (const double v : {1.0, 100.0}) rows.put_as(type, v).put(0.25).put_as(type, v).put(-2.5f);
      const Cloud cloud = load(content + rows.bytes());
      EXPECT_EQ(worlds(cloud), (Points{{0.25, 1.0, -2.5}, {0.25, 100.0, -2.5}}));
      EXPECT_EQ(values(cloud, "value"), (Doubles{1.0, 100.0}));
      EXPECT_EQ(cloud.info.schema.at(0), (Attribute{"value", type}));
      EXPECT_EQ(cloud.info.format, "PLY");
      EXPECT_EQ(cloud.info.version, "1.0");
      EXPECT_TRUE(contains(cloud.info.encoding, big ? "binary big-endian" : "binary little-endian"));

      const Cloud text = load(ascii("element vertex 2\nproperty " + std::string(name) +
                                        " value\nproperty double x\nproperty float y\nproperty float z\n",
                                    "1 0.25 1 -2.5\n100 .25 1e2 -25e-1\n"));
      EXPECT_EQ(worlds(text), worlds(cloud));
      EXPECT_EQ(values(text, "value"), values(cloud, "value"));
      EXPECT_EQ(text.info.schema, cloud.info.schema);
    }
}

TEST_F(Ply, ColorsOfEveryNameBecomeSixteenBits) {
  for (const std::string prefix : {"", "diffuse_"})
    for (const bool brief : {false, true}) {
      if (brief && !prefix.empty()) continue;
      const std::string red = prefix + (brief ? "r" : "red"), green = prefix + (brief ? "g" : "green"),
                        blue = prefix + (brief ? "b" : "blue");
      const Cloud cloud = load(
          ascii(vertex(2, "property uchar " + blue + "\nproperty uchar " + green + "\nproperty uchar " + red + "\n"),
                "0 0 0 3 2 1\n0 0 1 255 0 255\n"));
      EXPECT_EQ(names_of(cloud), Strings{"rgb"});
      EXPECT_EQ(values(cloud, "rgb"), (Doubles{257, 514, 771, 65535, 0, 65535}));
    }
}

TEST_F(Ply, ColorsOfEveryDepthBecomeSixteenBits) {
  const auto rgb = [&](const std::string& type, const std::string& row) {
    return values(
        load(ascii(vertex(1, "property " + type + " red\nproperty " + type + " green\nproperty " + type + " blue\n"),
                   "0 0 0 " + row + "\n")),
        "rgb");
  };
  EXPECT_EQ(rgb("ushort", "0 256 65535"), (Doubles{0, 256, 65535}));
  EXPECT_EQ(rgb("char", "-1 0 127"), (Doubles{65535, 0, 127 * 257}));
  EXPECT_EQ(rgb("float", "0 0.5 1"), (Doubles{0, 32768, 65535}));
  EXPECT_EQ(rgb("double", "0 0.2 1"), (Doubles{0, 13107, 65535}));
  EXPECT_EQ(rgb("float", "0 127 255"), (Doubles{0, 127 * 257, 65535}));
  EXPECT_EQ(rgb("int", "0 1 1"), (Doubles{0, 257, 257}));
  EXPECT_EQ(rgb("int", "0 255 70000"), (Doubles{0, 255, 65535}));
  EXPECT_EQ(rgb("float", "nan -1 1"), (Doubles{65535, 0, 65535}));
}

TEST_F(Ply, KnownAttributesGetTheirNamesAndOthersKeepThem) {
  const Cloud cloud = load(ascii(
      vertex(1,
             "property float scalar_Intensity\nproperty uchar alpha\nproperty float nx\nproperty float ny\nproperty "
             "float nz\nproperty int scalar_Label\nproperty uchar scalar_Classification\nproperty double GpsTime\n"
             "property float confidence\n"),
      "1 2 3 0.5 200 0 0 1 -7 2 1e9 0.75\n"));
  EXPECT_EQ(names_of(cloud), (Strings{"intensity", "alpha", "nx", "ny", "nz", "scalar_Label", "classification",
                                      "gps-time", "confidence"}));
  EXPECT_EQ(values(cloud, "intensity"), Doubles{0.5});
  EXPECT_EQ(values(cloud, "scalar_Label"), Doubles{-7});
  EXPECT_EQ(values(cloud, "gps-time"), Doubles{1e9});
  for (const std::string name : {"intensity", "scalar_intensity", "reflectance", "scalar_reflectance"})
    EXPECT_EQ(names_of(load(ascii(vertex(1, "property float " + name + "\n"), "1 2 3 4\n"))), Strings{"intensity"});
}

TEST_F(Ply, TwoAttributesOfOneNameAreBothKept) {
  const Cloud cloud =
      load(ascii(vertex(1, "property float intensity\nproperty float scalar_intensity\nproperty float intensity\n"),
                 "1 2 3 4 5 6\n"));
  EXPECT_EQ(names_of(cloud), (Strings{"intensity", "scalar_intensity", "intensity 2"}));
  EXPECT_EQ(values(cloud, "intensity 2"), Doubles{6});
}

const char kFaces[] = "element face 2\nproperty list uchar int vertex_indices\nproperty list ushort float uv\n";

TEST_F(Ply, ElementsBeforeAndBehindTheVerticesAreSkippedExactly) {
  EXPECT_EQ(worlds(load(ascii(kFaces + vertex(2) + "element edge 1\nproperty int a\n",
                              "3 0 1 2 2 .5 .5\n0 1 7\n1 2 3\n\n 4 5 6\n9\n"))),
            (Points{{1, 2, 3}, {4, 5, 6}}));
  for (const bool big : {false, true}) {
    Binary body(big);
    body.put(std::uint8_t{3}).put(0).put(1).put(2).put(std::uint16_t{2}).put(.5f).put(.5f);
    body.put(std::uint8_t{0}).put(std::uint16_t{1}).put(7.f);
    body.put(1.f).put(2.f).put(3.f).put(4.f).put(5.f).put(6.f).put(9);
    EXPECT_EQ(worlds(load(header(big ? "binary_big_endian" : "binary_little_endian",
                                 kFaces + vertex(2) + "element edge 1\nproperty int a\n") +
                          body.bytes())),
              (Points{{1, 2, 3}, {4, 5, 6}}));
  }
}

TEST_F(Ply, ListsOfVerticesAreSkippedExactly) {
  const std::string declarations =
      "element vertex 3\nproperty float x\nproperty list uchar short weights\nproperty float y\nproperty float "
      "z\nproperty list int double more\nproperty uchar intensity\n";
  const Points expected{{1, 2, 3}, {4, 5, 6}, {7, 8, 9}};
  const Cloud text = load(ascii(declarations, "1 2 8 9 2 3 0 11\n4 0 5 6 1 0.5 12\n7 1 1 8 9 0 13\n"));
  EXPECT_EQ(worlds(text), expected);
  EXPECT_EQ(values(text, "intensity"), (Doubles{11, 12, 13}));
  for (const bool big : {false, true}) {
    Binary body(big);
    for (int i = 0; i < 3; ++i) {
      body.put(static_cast<float>(3 * i + 1)).put(static_cast<std::uint8_t>(i));
      for (int k = 0; k < i; ++k) body.put(std::int16_t{77});
      body.put(static_cast<float>(3 * i + 2)).put(static_cast<float>(3 * i + 3)).put(2 - i);
      for (int k = 0; k < 2 - i; ++k) body.put(0.5);
      body.put(static_cast<std::uint8_t>(11 + i));
    }
    const Cloud cloud = load(header(big ? "binary_big_endian" : "binary_little_endian", declarations) + body.bytes());
    EXPECT_EQ(worlds(cloud), expected);
    EXPECT_EQ(values(cloud, "intensity"), (Doubles{11, 12, 13}));
  }
}

TEST_F(Ply, AListThatNoRowHasIsAWarning) {
  const std::string declarations = vertex(2, "property uchar a\nproperty list uchar uint vertex_indices\n");
  const Cloud cloud = load(ascii(declarations, "1 2 3 4\n5 6 7 8\n"));
  EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {5, 6, 7}}));
  EXPECT_EQ(values(cloud, "a"), (Doubles{4, 8}));
  EXPECT_TRUE(one_that_contains(cloud.info.warnings, "the list \"vertex_indices\", which the header declares"));
  // The first row says what all have
  EXPECT_TRUE(contains(error(ascii(declarations, "1 2 3 4\n5 6 7 8 0\n")), "line 11: has more than the 4 values"));
  EXPECT_TRUE(contains(error(ascii(declarations, "1 2 3 4 0\n5 6 7 8\n")), "line 11: has 4 values, and 5 were"));
  EXPECT_TRUE(contains(error(ascii(declarations, "1 2 3\n5 6 7\n")), "line 10: has 3 values, and 5 were"));
}

TEST_F(Ply, ManyRowsWithListsKeepTheirOrder) {
  constexpr int kRows = 40'000;  // more than two blocks
  Binary body;
  for (int i = 0; i < kRows; ++i) {
    body.put(static_cast<std::uint8_t>(i % 3));
    for (int k = 0; k < i % 3; ++k) body.put(-1);
    body.put(static_cast<float>(i)).put(0.f).put(1.f);
  }
  const Cloud cloud = load(header("binary_little_endian", "element vertex " + std::to_string(kRows) +
                                                              "\nproperty list uchar int l\nproperty float x\nproperty "
                                                              "float y\nproperty float z\n") +
                           body.bytes());
  ASSERT_EQ(cloud.size(), static_cast<std::size_t>(kRows));
  for (int i = 0; i < kRows; ++i)
    ASSERT_EQ(cloud.info.grid.world_from_grid(cloud.positions[static_cast<std::size_t>(i)]), glm::dvec3(i, 0, 1));
}

TEST_F(Ply, DisplazHasAnElementForEachAttribute) {
  const std::string declarations =
      "comment Displaz native\nelement vertex_position 2\nproperty float x\nproperty float y\nproperty float z\n"
      "element vertex_normal 2\nproperty float x\nproperty float y\nproperty float z\n"
      "element vertex_color 2\nproperty uint8 r\nproperty uint8 g\nproperty uint8 b\n"
      "element vertex_intensity 2\nproperty ushort 0\n"
      "element vertex_a 2\nproperty float 0\nproperty float 1\n";
  const auto expect = [](const Cloud& cloud) {
    EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(names_of(cloud), (Strings{"rgb", "nx", "ny", "nz", "intensity", "a"}));
    EXPECT_EQ(values(cloud, "ny"), (Doubles{0.5, 0.25}));
    EXPECT_EQ(values(cloud, "rgb"), (Doubles{257, 514, 771, 0, 0, 65535}));
    EXPECT_EQ(values(cloud, "intensity"), (Doubles{500, 600}));
    EXPECT_EQ(values(cloud, "a"), (Doubles{7, 8, 9, 10}));
  };
  expect(load(ascii(declarations, "1 2 3\n4 5 6\n0 .5 1\n0 .25 1\n1 2 3\n0 0 255\n500\n600\n7 8\n9 10\n")));
  Binary body;
  for (const float v : {1.f, 2.f, 3.f, 4.f, 5.f, 6.f, 0.f, .5f, 1.f, 0.f, .25f, 1.f}) body.put(v);
  for (const int v : {1, 2, 3, 0, 0, 255}) body.put(static_cast<std::uint8_t>(v));
  body.put(std::uint16_t{500}).put(std::uint16_t{600}).put(7.f).put(8.f).put(9.f).put(10.f);
  expect(load(header("binary_little_endian", declarations) + body.bytes()));
  EXPECT_TRUE(contains(error(ascii("element vertex_position 1\nproperty float x\nproperty float y\nproperty float z\n"
                                   "element vertex_a 2\nproperty float 0\n",
                                   "1 2 3\n7\n8\n")),
                       "\"vertex_a\" has 2 rows, and \"vertex_position\" has 1"));
}

TEST_F(Ply, HeadersEndTheirLinesInThreeWays) {
  std::string text = ascii("comment a\nobj_info b\n" + vertex(2), "1 2 3\n4 5 6\n");
  std::string binary = header("binary_little_endian", vertex(1));
  const Binary row = Binary().put(std::bit_cast<float>(0x3F00000A)).put(2.f).put(3.f);  // begins with a line end
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    const auto with_ends = [&](const std::string& from) {
      std::string to;
      for (const char c : from) c == '\n' ? to += end : to += c;
      return to;
    };
    EXPECT_EQ(worlds(load(with_ends(text))), (Points{{1, 2, 3}, {4, 5, 6}}));
    EXPECT_EQ(worlds(load(with_ends(binary) + row.bytes())),
              (Points{{static_cast<double>(std::bit_cast<float>(0x3F00000A)), 2, 3}}));
  }
}

TEST_F(Ply, CoordinatesKeepTheirDoubles) {
  Binary body;
  for (const double v : {4320978.61, 289814.15, 170.76, 4320978.84, 289814.64, 170.75}) body.put(v);
  const Cloud cloud = load(
      header("binary_little_endian", "element vertex 2\nproperty double x\nproperty double y\nproperty double z\n") +
      body.bytes());
  EXPECT_EQ(cloud.info.warnings, Strings{});
  const Points read = worlds(cloud);
  EXPECT_DOUBLE_EQ(read[0].x, 4320978.61);
  EXPECT_DOUBLE_EQ(read[1].y, 289814.64);
  EXPECT_DOUBLE_EQ(read[1].z, 170.75);
}

TEST_F(Ply, AsciiCoordinatesKeepDigitsThatAFloatHasNot) {
  const Cloud cloud = load(ascii(vertex(1), "289814.15 4320978.61 170.76\n"));
  EXPECT_DOUBLE_EQ(worlds(cloud)[0].y, 4320978.61);
}

TEST_F(Ply, PointsWithoutAFinitePositionAreLeftOutCountedAndReported) {
  const Cloud cloud =
      load(ascii(vertex(5, "property int id\n"), "1 2 3 0\nnan 2 3 1\n4 5 inf 2\n-inf 1 1 3\n7 8 9 4\n"));
  EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {7, 8, 9}}));
  EXPECT_EQ(values(cloud, "id"), (Doubles{0, 4}));
  EXPECT_EQ(cloud.info.point_count, 2u);
  EXPECT_EQ(cloud.info.dropped_points, 3u);
  EXPECT_TRUE(one_that_contains(cloud.info.warnings, "3 of 5 points have no finite position"));
}

TEST_F(Ply, AFileOfNaNsIsAnEmptyCloudThatSaysSo) {
  Binary body;
  for (int i = 0; i < 30; ++i) body.put(std::numeric_limits<float>::quiet_NaN());
  const Cloud cloud = load(header("binary_little_endian", vertex(10)) + body.bytes());
  EXPECT_EQ(cloud.size(), 0u);
  EXPECT_EQ(cloud.info.dropped_points, 10u);
  EXPECT_TRUE(one_that_contains(cloud.info.warnings, "10 of 10 points"));
}

TEST_F(Ply, WithoutZTheHeightIsZeroAndAWarningSaysSo) {
  const Cloud cloud = load(ascii("element vertex 1\nproperty float x\nproperty float y\n", "1 2\n"));
  EXPECT_EQ(worlds(cloud), (Points{{1, 2, 0}}));
  EXPECT_TRUE(one_that_contains(cloud.info.warnings, "no z"));
}

TEST_F(Ply, HeaderFaultsNameTheByteAndWhatWasExpected) {
  EXPECT_TRUE(contains(error("ply\nformat ascii 1.0\nend_header\n"), "no element \"vertex\""));
  EXPECT_TRUE(contains(error(ascii("element face 0\nproperty int a\n", "")), "it declares face"));
  EXPECT_TRUE(contains(error(ascii("element vertex 0\nproperty float a\n", "")), "the points have no x; they have: a"));
  EXPECT_TRUE(contains(error("ply\nformat ascii 1.0\nelement vertex 1\n"), "at byte 38: the header ends here"));
  EXPECT_TRUE(
      contains(error("ply\nelement vertex 0\nproperty float x\nproperty float y\nend_header\n"), "no line \"format\""));
  EXPECT_TRUE(
      contains(error("ply\nformat binary 1.0\nend_header\n"), "at byte 4: the header's line \"format binary 1.0\""));
  EXPECT_TRUE(contains(error(ascii("element vertex many\n", "")), "at byte 21: "));
  EXPECT_TRUE(contains(error(ascii("element vertex -1\n", "")), "element, a name and a count"));
  EXPECT_TRUE(contains(error(ascii("property float x\n", "")), "an element before its properties"));
  EXPECT_TRUE(contains(error(ascii("element vertex 1\nproperty real x\n", "")), "a type, such as float"));
  EXPECT_TRUE(contains(error(ascii("element vertex 1\nproperty list float int x\n", "")), "the length of a list"));
  EXPECT_TRUE(contains(error(ascii("vertices 3\n", "")), "format, element, property"));
  std::string endless = "element vertex 1\n";
  for (int i = 0; i < 5'000; ++i) endless += "property float x\n";
  EXPECT_TRUE(contains(error(ascii(endless, "")), "more than 4096 elements and properties"));
}

TEST_F(Ply, RowFaultsNameTheLine) {
  EXPECT_TRUE(contains(error(ascii(vertex(2), "1 2 3\n4 5\n")), "line 9: has 2 values, and 3 were expected"));
  EXPECT_TRUE(contains(error(ascii(vertex(2), "1 2 3\n4 5 6 7\n")), "line 9: has more than the 3 values"));
  EXPECT_TRUE(
      contains(error(ascii(vertex(2), "1 2 3\n4 5,6 6\n")), "line 9: \"5,6\" was found where the value of \"y\""));
  EXPECT_TRUE(contains(error(ascii(vertex(1, "property uchar a\n"), "1 2 3 300\n")), "\"300\""));
  EXPECT_TRUE(contains(error(ascii(vertex(1, "property uchar a\n"), "1 2 3 .5\n")), "\".5\""));
  EXPECT_TRUE(contains(error(ascii(vertex(1, "property list uchar int a\n"), "1 2 3 -2\n")), "length of a list"));
  EXPECT_TRUE(contains(error(ascii(vertex(3), "1 2 3\n4 5 6\n")),
                       "line 10: the file ends here, with 2 of the 3 rows that the header states"));
}

TEST_F(Ply, ACountBeyondTheFileIsAnErrorBeforeAnythingIsAllocated) {
  for (const char* count : {"1000000000000", "18446744073709551615"}) {
    const std::string declared =
        "element vertex " + std::string(count) + "\nproperty float x\nproperty float y\nproperty float z\n";
    EXPECT_TRUE(contains(error(header("binary_little_endian", declared) + std::string(24, 'a')),
                         "at byte 36: the header states " + std::string(count)));
    EXPECT_TRUE(contains(error(ascii(declared, "1 2 3\n")), "the file ends here, with 1 of"));
    EXPECT_TRUE(contains(error(header("binary_little_endian", "element face " + std::string(count) +
                                                                  "\nproperty list uchar int i\n" + vertex(1)) +
                               std::string(24, '\0')),
                         "the header states " + std::string(count)));
  }
  EXPECT_TRUE(
      contains(error(header("binary_little_endian", "element face 1\nproperty list int double i\n" + vertex(1)) +
                     Binary().put(0x7FFFFFFF).put(0.0).put(0.0).bytes()),
               "the file ends in row 1 of the 1 of element \"face\""));
  EXPECT_TRUE(
      contains(error(header("binary_little_endian", "element face 1\nproperty list int double i\n" + vertex(1)) +
                     Binary().put(-1).put(0.0).put(0.0).bytes()),
               "a list has a negative length"));
}

TEST_F(Ply, ACountBelowWhatTheFileHasIsAWarning) {
  EXPECT_TRUE(one_that_contains(open(ascii(vertex(1), "1 2 3\n4 5 6\n"))->info().warnings, "1 more lines"));
  EXPECT_TRUE(one_that_contains(
      open(header("binary_little_endian", vertex(1)) + std::string(24, '\0'))->info().warnings, "12 more bytes"));
  EXPECT_TRUE(one_that_contains(open(ascii(vertex(1), "1 2 3"))->info().warnings, "no line end"));
}

}  // namespace
}  // namespace stipple::test::read_ply
