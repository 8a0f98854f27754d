// Extra bytes as the parser describes them.
#include <gtest/gtest.h>

#include <algorithm>

#include "octree/read/las/las_header.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test::octree_las_extra_bytes {
namespace {

using test::Bytes;
using test::ExtraAttribute;
using test::LasFile;
using test::one_that_contains;
using test::Strings;

using Fields = std::vector<las::Field>;

constexpr int kHasScale = 8, kHasOffset = 16;

struct Parsed {
  std::vector<las::Field> extra;
  std::vector<std::string> warnings;
};

// Point format 0 with `size` extra bytes described by `attributes`; only what is behind the format's own fields.
Parsed parse_extra(std::size_t size, const std::vector<ExtraAttribute>& attributes) {
  LasFile file{.extra_bytes = size};
  if (!attributes.empty()) file.vlrs.push_back(test::extra_bytes_record(attributes));
  las::Header header = las::parse_header(file.bytes(), "made.las");
  const auto own = las::point_fields(0).size();
  header.fields.erase(header.fields.begin(), header.fields.begin() + static_cast<std::ptrdiff_t>(own));
  return {header.fields, header.warnings};
}

TEST(LasExtraBytes, AllTenScalarTypesAreKnown) {
  const ScalarType types[] = {ScalarType::u8,  ScalarType::i8,  ScalarType::u16, ScalarType::i16, ScalarType::u32,
                              ScalarType::i32, ScalarType::u64, ScalarType::i64, ScalarType::f32, ScalarType::f64};
  for (int type = 1; type <= 10; ++type) {
    const ScalarType scalar = types[type - 1];
    const Parsed parsed = parse_extra(size_of(scalar), {{"a", type}});
    EXPECT_EQ(parsed.extra, (Fields{las::Field{{"a", scalar}, 20}}));
    EXPECT_EQ(parsed.warnings, Strings{});
  }
}

TEST(LasExtraBytes, DeprecatedTypesAreAttributesOfTwoAndThreeComponents) {
  EXPECT_EQ(parse_extra(2 * 1, {{"a", 11}}).extra, (Fields{las::Field{{"a", ScalarType::u8, 2}, 20}}));
  EXPECT_EQ(parse_extra(2 * 8, {{"a", 20}}).extra, (Fields{las::Field{{"a", ScalarType::f64, 2}, 20}}));
  EXPECT_EQ(parse_extra(3 * 2, {{"a", 23}}).extra, (Fields{las::Field{{"a", ScalarType::u16, 3}, 20}}));
  EXPECT_EQ(parse_extra(3 * 8, {{"a", 30}}).extra, (Fields{las::Field{{"a", ScalarType::f64, 3}, 20}}));
}

TEST(LasExtraBytes, ComponentsWithScalesOfTheirOwnBecomeAttributesOfTheirOwn) {
  EXPECT_EQ(
      parse_extra(4, {{"a", 14, kHasScale, {0.1, 0.2}}}).extra,
      (Fields{las::Field{{"a[0]", ScalarType::i16, 1, 0.1}, 20}, las::Field{{"a[1]", ScalarType::i16, 1, 0.2}, 22}}));
}

TEST(LasExtraBytes, UndocumentedBytesAreAsManyAsTheirOptionsSay) {
  EXPECT_EQ(parse_extra(7, {{"a", 0, 7}}).extra, (Fields{las::Field{{"a", ScalarType::u8, 7}, 20}}));
}

TEST(LasExtraBytes, AttributesStandOneBehindTheOther) {
  EXPECT_EQ(parse_extra(11, {{"a", 3}, {"b", 10}, {"c", 1}}).extra,
            (Fields{las::Field{{"a", ScalarType::u16}, 20}, las::Field{{"b", ScalarType::f64}, 22},
                    las::Field{{"c", ScalarType::u8}, 30}}));
}

TEST(LasExtraBytes, ScaleAndOffsetCountOnlyWhereTheOptionsSaySo) {
  const std::vector<double> half{0.5}, ten{10.0};
  EXPECT_EQ(parse_extra(4, {{"a", 5, kHasScale | kHasOffset, half, ten}}).extra,
            (Fields{las::Field{{"a", ScalarType::u32, 1, 0.5, 10.0}, 20}}));
  EXPECT_EQ(parse_extra(4, {{"a", 5, 0, half, ten}}).extra, (Fields{las::Field{{"a", ScalarType::u32}, 20}}));
}

TEST(LasExtraBytes, AScaleOfZeroIsIgnoredWithAWarning) {
  const Parsed parsed = parse_extra(4, {{"a", 5, kHasScale, {0.0}}});
  EXPECT_EQ(parsed.extra, (Fields{las::Field{{"a", ScalarType::u32}, 20}}));
  EXPECT_TRUE(one_that_contains(parsed.warnings, "\"a\" states a scale of zero"));
}

TEST(LasExtraBytes, BytesNobodyDescribesAreOneColumn) {
  EXPECT_EQ(parse_extra(5, {}).extra, (Fields{las::Field{{"extra bytes", ScalarType::u8, 5}, 20}}));
}

TEST(LasExtraBytes, BytesBehindTheDescribedOnesAreOneColumn) {
  const Parsed parsed = parse_extra(5, {{"a", 3}});
  EXPECT_EQ(parsed.extra,
            (Fields{las::Field{{"a", ScalarType::u16}, 20}, las::Field{{"extra bytes", ScalarType::u8, 3}, 22}}));
  EXPECT_EQ(parsed.warnings, Strings{});
}

TEST(LasExtraBytes, ADescriptionOfMoreBytesThanThereAreIsNotUsed) {
  const Parsed parsed = parse_extra(5, {{"a", 3}, {"b", 5}});
  EXPECT_EQ(parsed.extra, (Fields{las::Field{{"extra bytes", ScalarType::u8, 5}, 20}}));
  EXPECT_TRUE(one_that_contains(parsed.warnings, "\"b\" takes 4 bytes, and 3 of the record are left"));
}

TEST(LasExtraBytes, AnUnknownDataTypeMakesTheDescriptionUnused) {
  const Parsed parsed = parse_extra(5, {{"a", 31}});
  EXPECT_EQ(parsed.extra, (Fields{las::Field{{"extra bytes", ScalarType::u8, 5}, 20}}));
  EXPECT_TRUE(one_that_contains(parsed.warnings, "data type 31"));
}

TEST(LasExtraBytes, NamesAreUniqueAndNeverEmpty) {
  const Parsed parsed = parse_extra(5, {{"a", 1}, {"a", 1}, {"intensity", 1}, {"", 1}});
  std::vector<std::string> names;
  for (const las::Field& field : parsed.extra) names.push_back(field.attribute.name);
  EXPECT_EQ(names, (Strings{"a", "a 2", "intensity 2", "extra bytes", "extra bytes 2"}));
}

TEST(LasExtraBytes, NamesOf32CharactersNeedNoZero) {
  const std::string name(32, 'n');
  EXPECT_EQ(parse_extra(1, {{name, 1}}).extra[0].attribute.name, name);
}

TEST(LasExtraBytes, NamesAreValidUtf8) {
  EXPECT_EQ(parse_extra(1, {{"H\xC3\xB6he \xE2\x82\xAC", 1}}).extra[0].attribute.name, "H\xC3\xB6he \xE2\x82\xAC");
  EXPECT_EQ(parse_extra(1, {{"H\xF6he\x01\xED\xA0\x80", 1}}).extra[0].attribute.name, "H?he????");
}

TEST(LasExtraBytes, AnExtendedRecordDescribesThemJustAsWell) {
  const LasFile file{
      .minor = 4, .format = 6, .extra_bytes = 4, .evlrs = {{"x", 4, Bytes(7)}, test::extra_bytes_record({{"a", 9}})}};
  const las::Header header = las::parse_header(file.bytes(), "made.las");
  EXPECT_EQ(header.fields.back(), (las::Field{{"a", ScalarType::f32}, 30}));
  EXPECT_EQ(header.warnings, Strings{});
}

TEST(LasExtraBytes, TheVlrIsUsedWhereBothDescribeThem) {
  const LasFile file{.minor = 4,
                     .format = 6,
                     .extra_bytes = 4,
                     .vlrs = {test::extra_bytes_record({{"near", 9}})},
                     .evlrs = {test::extra_bytes_record({{"far", 9}})}};
  EXPECT_EQ(las::parse_header(file.bytes(), "made.las").fields.back().attribute.name, "near");
}

}  // namespace
}  // namespace stipple::test::octree_las_extra_bytes
