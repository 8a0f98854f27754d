// The LAS header parser on headers that keep to the specification, and on those that lie.
#include "octree/read/las/las_header.h"

#include <gtest/gtest.h>

#include <limits>

#include "tests/octree/las_fixture.h"

namespace stipple::test::octree_las_header {
namespace {

using test::any_contains;
using test::Bytes;
using test::contains;
using test::error_of;
using test::LasFile;
using test::one_that_contains;
using test::put;
using test::Strings;

las::Header parse(const Bytes& bytes) {
  return las::parse_header(bytes, "made.las");
}

std::string parse_error(const Bytes& bytes) {
  return error_of([&] { parse(bytes); });
}

TEST(LasHeader, EveryFormatOfEveryVersionIsParsed) {
  for (int minor = 0; minor <= 5; ++minor)
    for (int format = 0; format <= las::kHighestFormats[static_cast<std::size_t>(minor)]; ++format) {
      SCOPED_TRACE("LAS 1." + std::to_string(minor) + ", point format " + std::to_string(format));
      const LasFile file{.minor = minor, .format = format};
      const las::Header header = parse(file.bytes());
      EXPECT_EQ(header.version_minor, minor);
      EXPECT_EQ(header.point_format, format);
      EXPECT_EQ(header.record_length, file.record_length());
      EXPECT_EQ(header.points_begin, file.points_begin());
      EXPECT_EQ(header.point_count, 3u);
      EXPECT_EQ(header.warnings, Strings{});
    }
}

TEST(LasHeader, FieldsAndPositionFillTheRecordOfEveryFormatExactly) {
  for (int format = 0; format <= 10; ++format) {
    SCOPED_TRACE(format);
    EXPECT_EQ(las::record_size(format), test::kRecordSizes[format]);
    std::size_t bits = 8 * 12;
    for (const las::Field& field : las::point_fields(format))
      bits += field.bits != 0 ? static_cast<std::size_t>(field.bits) : 8 * field.attribute.bytes();
    EXPECT_EQ(bits, 8 * test::kRecordSizes[format]);
  }
}

TEST(LasHeader, GridAndBoundsAreTakenAsStated) {
  const las::Header header = parse(LasFile{}.bytes());
  EXPECT_EQ(header.grid.scale, glm::dvec3(0.01, 0.02, 0.5));
  EXPECT_EQ(header.grid.offset, glm::dvec3(100.0, -200.0, 3e6));
  EXPECT_EQ(header.stated_bounds.min, glm::dvec3(100.0, -200.0, 3e6));
  EXPECT_EQ(header.stated_bounds.max, glm::dvec3(200.0, -100.0, 4e6));
}

TEST(LasHeader, BoundsThatAreNoBoxAreLeftOutWithAWarning) {
  Bytes bytes = LasFile{}.bytes();
  put(bytes, las::kBounds, std::numeric_limits<double>::quiet_NaN());
  const las::Header header = parse(bytes);
  EXPECT_TRUE(header.stated_bounds.empty());
  EXPECT_TRUE(one_that_contains(header.warnings, "no box"));
}

TEST(LasHeader, AFileWithoutPointsIsAFile) {
  const las::Header header = parse(LasFile{.points = 0}.bytes());
  EXPECT_EQ(header.point_count, 0u);
  EXPECT_TRUE(header.stated_bounds.empty());
}

TEST(LasHeader, HeadersLongerThanTheVersionNeedsAreSkipped) {
  Bytes bytes = LasFile{}.bytes();
  bytes.insert(bytes.begin() + 227, 10, std::byte{0xAB});
  put(bytes, las::kHeaderSize, std::uint16_t{237});
  put(bytes, las::kOffsetToPoints, std::uint32_t{237});
  EXPECT_EQ(parse(bytes).points_begin, 237u);
}

TEST(LasHeader, AFormatNewerThanTheVersionIsReadWithAWarning) {
  const las::Header header = parse(LasFile{.minor = 2, .format = 7}.bytes());
  EXPECT_EQ(header.point_count, 3u);
  EXPECT_TRUE(one_that_contains(header.warnings, "Point format 7 is none of LAS 1.2"));
}

TEST(LasHeader, AnotherSignatureIsNamedAtByte0) {
  Bytes bytes = LasFile{}.bytes();
  test::put_text(bytes, 0, "LASX");
  EXPECT_TRUE(contains(parse_error(bytes), "made.las: at byte 0: "));
}

TEST(LasHeader, VersionsThatAreNotReadAreNamed) {
  for (const auto& [major, minor] : {std::pair{1, 6}, std::pair{2, 0}, std::pair{0, 9}}) {
    Bytes bytes = LasFile{}.bytes();
    put(bytes, las::kVersionMajor, static_cast<std::uint8_t>(major));
    put(bytes, las::kVersionMinor, static_cast<std::uint8_t>(minor));
    const std::string message = parse_error(bytes);
    EXPECT_TRUE(contains(message, "at byte 24: "));
    EXPECT_TRUE(contains(message, "version " + std::to_string(major) + "." + std::to_string(minor)));
  }
}

TEST(LasHeader, AHeaderSizeBelowTheVersionsIsNamedAtByte94) {
  Bytes bytes = LasFile{.minor = 4}.bytes();
  put(bytes, las::kHeaderSize, std::uint16_t{227});
  EXPECT_TRUE(contains(parse_error(bytes), "at byte 94: a header of 227 bytes"));
}

TEST(LasHeader, AnOffsetToPointsOutsideTheFileOrInsideTheHeaderIsNamedAtByte96) {
  Bytes bytes = LasFile{}.bytes();
  for (const std::size_t offset : {std::size_t{0}, std::size_t{226}, bytes.size() + 1, std::size_t{0xFFFFFFFF}}) {
    put(bytes, las::kOffsetToPoints, static_cast<std::uint32_t>(offset));
    EXPECT_TRUE(contains(parse_error(bytes), "at byte 96: the points are said to begin at byte"));
  }
}

TEST(LasHeader, ACompressedFileIsSaidToBeLaz) {
  Bytes bytes = LasFile{.format = 3}.bytes();
  put(bytes, las::kPointFormat, std::uint8_t{0x83});
  const las::Header header = parse(bytes);
  EXPECT_TRUE(header.compressed);
  EXPECT_EQ(header.point_format, 3);
}

TEST(LasHeader, AnUnknownPointFormatIsNamedAtByte104) {
  Bytes bytes = LasFile{}.bytes();
  put(bytes, las::kPointFormat, std::uint8_t{11});
  EXPECT_TRUE(contains(parse_error(bytes), "at byte 104: point format 11"));
}

TEST(LasHeader, ARecordShorterThanItsFormatIsNamedAtByte105) {
  for (int format = 0; format <= 10; ++format) {
    Bytes bytes = LasFile{.minor = 4, .format = format}.bytes();
    put(bytes, las::kRecordLength, static_cast<std::uint16_t>(test::kRecordSizes[format] - 1));
    EXPECT_TRUE(contains(parse_error(bytes), "at byte 105: "));
  }
}

TEST(LasHeader, ScalesThatSpanNoGridAreNamedAtTheirByte) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  for (const double scale : {0.0, -0.01, kNan, kInf, -kInf}) {
    Bytes bytes = LasFile{}.bytes();
    put(bytes, las::kScale + 8, scale);
    EXPECT_TRUE(contains(parse_error(bytes), "at byte 139: the scale of y is"));
  }
}

TEST(LasHeader, OffsetsThatAreNotFiniteAreNamedAtTheirByte) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN(), kInf = std::numeric_limits<double>::infinity();
  for (const double offset : {kNan, kInf, -kInf}) {
    Bytes bytes = LasFile{}.bytes();
    put(bytes, las::kOffset + 16, offset);
    EXPECT_TRUE(contains(parse_error(bytes), "at byte 171: with an offset of"));
  }
}

TEST(LasHeader, AScaleThatReachesInfinityWithinInt32IsRefused) {
  Bytes bytes = LasFile{}.bytes();
  put(bytes, las::kScale, 1e300);
  EXPECT_TRUE(contains(parse_error(bytes), "x is not finite"));
}

TEST(LasHeader, MissingPointsAreNamedWhereTheFileEndsWithTheNumberOfWholeOnes) {
  Bytes bytes = LasFile{.format = 2, .points = 10}.bytes();
  bytes.resize(bytes.size() - 27);  // one record of 26 bytes and one byte of another
  EXPECT_TRUE(contains(parse_error(bytes),
                       "at byte " + std::to_string(bytes.size()) + ": the file ends here, with 8 of the 10 points"));
}

TEST(LasHeader, CountsWhoseBytesOverflow64BitsAreRefused) {
  Bytes bytes = LasFile{.minor = 4, .format = 6}.bytes();
  for (const std::uint64_t count : {~std::uint64_t{0}, std::uint64_t{1} << 63, ~std::uint64_t{0} / 30 + 1}) {
    put(bytes, las::kPointCount, count);
    EXPECT_TRUE(contains(parse_error(bytes), "with 3 of the " + std::to_string(count) + " points"));
  }
}

TEST(LasHeader, The64BitCountIsUsedWhereTheLegacyCountIsZero) {
  EXPECT_EQ(parse(LasFile{.minor = 4, .format = 6, .points = 5}.bytes()).point_count, 5u);
}

TEST(LasHeader, CountsThatContradictEachOtherAreRefused) {
  Bytes bytes = LasFile{.minor = 4, .format = 6, .points = 5}.bytes();
  put(bytes, las::kLegacyPointCount, std::uint32_t{4});
  EXPECT_TRUE(contains(parse_error(bytes), "at byte 107: 4 points are stated here and 5 at byte 247"));
}

TEST(LasHeader, MoreVlrsThanThereIsRoomForAreAWarning) {
  Bytes bytes = LasFile{.vlrs = {{"somebody", 1, Bytes(10)}}}.bytes();
  put(bytes, las::kVlrCount, std::uint32_t{1'069'128'089});
  const las::Header header = parse(bytes);
  EXPECT_EQ(header.point_count, 3u);
  EXPECT_TRUE(one_that_contains(header.warnings,
                                "1069128089 variable length records, but before the points there "
                                "is room for only 1"));
}

TEST(LasHeader, AVlrThatReachesIntoThePointsIsNamedAtItsLength) {
  Bytes bytes = LasFile{.vlrs = {{"somebody", 1, Bytes(10)}, {"somebody", 2, Bytes(10)}}}.bytes();
  put(bytes, 227 + 64 + 20, std::uint16_t{11});
  EXPECT_TRUE(contains(parse_error(bytes), "at byte 311: variable length record 2 states 11 bytes"));
}

TEST(LasHeader, EvlrsThatAreNotThereAreAWarning) {
  const LasFile file{.minor = 4, .format = 6, .evlrs = {{"somebody", 1, Bytes(10)}}};
  for (const std::uint64_t length : {std::uint64_t{11}, ~std::uint64_t{0}}) {
    Bytes bytes = file.bytes();
    put(bytes, file.points_end() + 20, length);
    EXPECT_TRUE(one_that_contains(parse(bytes).warnings, "reaches beyond the end of the file"));
  }
  for (const std::uint64_t start : {std::uint64_t{1'000'000}, ~std::uint64_t{0}}) {
    Bytes bytes = file.bytes();
    put(bytes, las::kEvlrStart, start);
    EXPECT_TRUE(any_contains(parse(bytes).warnings, "reaches beyond the end of the file"));
  }
}

TEST(LasHeader, EvlrsSaidToStandAmongThePointsAreAWarning) {
  Bytes bytes = LasFile{.minor = 4, .format = 6, .evlrs = {{"somebody", 1, Bytes(10)}}}.bytes();
  put(bytes, las::kEvlrStart, std::uint64_t{380});
  EXPECT_TRUE(any_contains(parse(bytes).warnings, "before the end of the points"));
}

TEST(LasHeader, UnexplainedBytesThatWouldHoldAPointAreAWarning) {
  Bytes bytes = LasFile{}.bytes();
  bytes.resize(bytes.size() + 19);
  EXPECT_EQ(parse(bytes).warnings, Strings{});
  bytes.resize(bytes.size() + 1);
  EXPECT_TRUE(one_that_contains(parse(bytes).warnings, "they would hold 1 more points"));
}

TEST(LasHeader, EvlrsAndWaveformsBehindThePointsAreExplained) {
  EXPECT_EQ(parse(LasFile{.minor = 4, .format = 6, .evlrs = {{"somebody", 1, Bytes(100)}}}.bytes()).warnings,
            Strings{});
  const LasFile file{.minor = 3, .format = 4};
  Bytes bytes = file.bytes();
  put(bytes, las::kWaveformStart, static_cast<std::uint64_t>(file.points_end()));
  bytes.resize(bytes.size() + 1000);
  EXPECT_EQ(parse(bytes).warnings, Strings{});
}

}  // namespace
}  // namespace stipple::test::octree_las_header
