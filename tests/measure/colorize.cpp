#include "render/store/colorize.h"

#include <cmath>
#include <limits>
#include <set>

#include "tests/octree/las_fixture.h"

namespace stipple::test::measure_colorize {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

template <class T>
Column column_of(const std::string& name, ScalarType type, int components, const std::vector<T>& values) {
  Column column{{.name = name, .type = type, .components = components}, {}};
  column.resize(values.size() / static_cast<std::size_t>(components));
  std::ranges::copy(values, column.as<T>().begin());
  return column;
}

// Points at heights 0, 1, 2, ... with one attribute.
Cloud cloud_with(const Column& column) {
  Cloud cloud;
  cloud.info.path = "test";
  cloud.info.schema = {column.attribute};
  for (std::size_t i = 0; i < column.points(); ++i) cloud.positions.push_back({0, 0, static_cast<int>(i)});
  cloud.columns = {column};
  return cloud;
}

std::vector<std::uint32_t> colors_of(const Column& column) {
  std::vector<std::uint32_t> colors;
  for (const PackedPoint& point : make_point_set(cloud_with(column), column.attribute.name).points)
    colors.push_back(point.rgba);
  return colors;
}

std::vector<std::uint32_t> rgb_colors(const std::vector<std::uint16_t>& values) {
  return colors_of(column_of("rgb", ScalarType::u16, 3, values));
}

std::vector<std::uint32_t> colors_by(const std::string& name, const std::vector<double>& values) {
  return colors_of(column_of(name, ScalarType::f64, 1, values));
}

int red(std::uint32_t rgba) {
  return static_cast<int>(rgba & 0xFFu);
}
bool is_grey(std::uint32_t rgba) {
  return red(rgba) == static_cast<int>(rgba >> 8 & 0xFFu) && red(rgba) == static_cast<int>(rgba >> 16 & 0xFFu);
}

TEST(Colorize, RgbOfSixteenBitsKeepsTheUpperByteAndRedIsLowest) {
  EXPECT_EQ(rgb_colors({0x1234, 0x5678, 0x9ABC, 0xFFFF, 0x00FF, 0x0100}),
            (std::vector<std::uint32_t>{0xFF9A5612u, 0xFF0100FFu}));
}

TEST(Colorize, RgbThatNeverExceeds255IsTakenAsItIs) {
  EXPECT_EQ(rgb_colors({1, 2, 3, 255, 0, 128}), (std::vector<std::uint32_t>{0xFF030201u, 0xFF8000FFu}));
}

TEST(Colorize, ASingleChannelAbove255DecidesForAllPoints) {
  EXPECT_EQ(rgb_colors({255, 255, 255, 0, 0, 256}), (std::vector<std::uint32_t>{0xFF000000u, 0xFF010000u}));
}

TEST(Colorize, IntensityIsGreyStretchedBetweenThePercentiles) {
  std::vector<std::uint16_t> values(1'001);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<std::uint16_t>(5'000 + i);
  values[1'000] = 65'535;  // a single flash must not darken the rest
  const auto colors = colors_of(column_of("intensity", ScalarType::u16, 1, values));
  for (std::size_t i = 0; i < colors.size(); ++i) {
    EXPECT_TRUE(is_grey(colors[i]));
    EXPECT_EQ(colors[i] >> 24, 0xFFu);
    if (i > 0) {
      EXPECT_GE(red(colors[i]), red(colors[i - 1]));
    }
  }
  EXPECT_EQ(red(colors[10]), 0);
  EXPECT_NEAR(red(colors[500]), 128, 1);
  EXPECT_EQ(red(colors[990]), 255);
  EXPECT_EQ(red(colors[1'000]), 255);
}

TEST(Colorize, HeightRunsFromDarkBlueToYellow) {
  Cloud cloud = cloud_with(column_of("intensity", ScalarType::u16, 1, std::vector<std::uint16_t>(1'000)));
  const PointSet set = make_point_set(cloud, "height");
  EXPECT_EQ(set.points.front().rgba, 0xFF540144u);
  EXPECT_EQ(set.points.back().rgba, 0xFF25E7FDu);
  EXPECT_NE(set.points[500].rgba, set.points.front().rgba);
}

TEST(Colorize, HeightsAtTheEndsOfInt32AreStretchedToo) {
  Cloud cloud = cloud_with(column_of("intensity", ScalarType::u16, 1, std::vector<std::uint16_t>(2)));
  cloud.positions[0].z = std::numeric_limits<int>::min();
  cloud.positions[1].z = std::numeric_limits<int>::max();
  const PointSet set = make_point_set(cloud, "height");
  EXPECT_EQ(set.points[0].rgba, 0xFF540144u);
  EXPECT_NE(set.points[1].rgba, set.points[0].rgba);
}

TEST(Colorize, ClassesHaveColoursOfTheirOwnThatRepeatAfterNineteen) {
  std::vector<std::uint8_t> classes(256);
  for (std::size_t i = 0; i < classes.size(); ++i) classes[i] = static_cast<std::uint8_t>(i);
  const auto colors = colors_of(column_of("classification", ScalarType::u8, 1, classes));
  for (std::size_t a = 0; a < 19; ++a)
    for (std::size_t b = 0; b < a; ++b) EXPECT_NE(colors[a], colors[b]) << a << " " << b;
  for (std::size_t i = 19; i < 256; ++i) EXPECT_EQ(colors[i], colors[i - 19]);
}

TEST(Colorize, WhatIsNoClassHasTheColourOfClassZero) {
  const auto colors = colors_by("classification", {0.0, kNan, -1.0, kInfinity, 1e30, 2.0});
  for (std::size_t i = 0; i < 5; ++i) EXPECT_EQ(colors[i], colors[0]);
  EXPECT_NE(colors[5], colors[0]);
}

TEST(Colorize, EqualValuesGetOneColour) {
  const auto colors = colors_by("gps-time", std::vector<double>(100, 7.5));
  for (const std::uint32_t color : colors) EXPECT_EQ(color, colors.front());
}

TEST(Colorize, WhatIsNoNumberGetsTheLowestColourAndDisturbsNoOther) {
  const auto colors = colors_by("gps-time", {0.0, kNan, 1.0, kInfinity, -kInfinity, 2.0});
  EXPECT_EQ(colors[1], colors[0]);
  EXPECT_EQ(colors[4], colors[0]);
  EXPECT_NE(colors[2], colors[0]);
  EXPECT_EQ(colors_by("gps-time", {kNan, kNan}), (std::vector<std::uint32_t>(2, colors[0])));
}

TEST(Colorize, OfSeveralComponentsTheFirstCounts) {
  const auto colors =
      colors_of(column_of("normal", ScalarType::f64, 3, std::vector<double>{0, 9, 9, 0, 1, 1, 5, 0, 0}));
  EXPECT_EQ(colors[0], colors[1]);
  EXPECT_NE(colors[0], colors[2]);
}

TEST(Colorize, PointsOfHiddenClassesAreMarkedWhateverTheColour) {
  Cloud cloud = cloud_with(column_of("classification", ScalarType::u8, 1, std::vector<std::uint8_t>{2, 7, 200, 18}));
  for (const char* attribute : {"height", "classification"}) {
    ColorChoice choice(attribute);
    choice.hidden.set(7).set(200);
    const ColorMap map = choice.complete(map_colors(cloud, attribute));
    EXPECT_EQ(attribute_names_of(map, {cloud.columns[0].attribute}), Strings{"classification"});
    const PointSet set = make_point_set(cloud, map);
    for (const auto& [i, hidden] : {std::pair{0u, false}, {1u, true}, {2u, true}, {3u, false}})
      EXPECT_EQ(set.points[i].rgba >> 24, hidden ? 0u : 255u) << attribute << ' ' << i;
  }
  EXPECT_TRUE(attribute_names_of({.attribute = "height"}, {cloud.columns[0].attribute}).empty());
}

TEST(Colorize, EveryRampGoesFromOneColourToAnother) {
  std::set<std::vector<std::uint32_t>> all;
  for (const Ramp ramp : all_ramps()) {
    EXPECT_EQ(ramp_named(name_of(ramp)), ramp);
    const Cloud cloud = cloud_with(column_of("gps-time", ScalarType::f64, 1, std::vector<double>{0, 0.25, 0.5, 1}));
    std::vector<std::uint32_t> colors;
    for (const PackedPoint& point : make_point_set(cloud, {.attribute = "gps-time", .ramp = ramp}).points)
      colors.push_back(point.rgba);
    EXPECT_EQ(std::set(colors.begin(), colors.end()).size(), 4u) << name_of(ramp);
    all.insert(colors);
  }
  EXPECT_EQ(all.size(), all_ramps().size());
  EXPECT_FALSE(ramp_named("rainbow"));
}

TEST(Colorize, TheRampOfTheHeightFieldPaperIsBlueYellowRed) {
  const Cloud cloud = cloud_with(column_of("gps-time", ScalarType::f64, 1, std::vector<double>{0, 0.5, 1}));
  const PointSet set = make_point_set(cloud, {.attribute = "gps-time", .ramp = Ramp::height_field});
  EXPECT_EQ(set.points[0].rgba, 0xFFFF0000u);
  EXPECT_EQ(set.points[1].rgba, 0xFF00FFFFu);
  EXPECT_EQ(set.points[2].rgba, 0xFF0000FFu);
}

TEST(Colorize, AnEmptyCloudStaysEmpty) {
  EXPECT_TRUE(rgb_colors({}).empty());
  EXPECT_TRUE(colors_by("gps-time", {}).empty());
  EXPECT_EQ(make_point_set(Cloud{}, "height").size(), 0u);
}

TEST(Colorize, KeepsPositionsGridAndBounds) {
  Cloud cloud = cloud_with(column_of("intensity", ScalarType::u16, 1, std::vector<std::uint16_t>(3)));
  cloud.info.grid = {glm::dvec3(1, 2, 3), glm::dvec3(0.5)};
  cloud.bounds = {glm::ivec3(0, 0, 0), glm::ivec3(0, 0, 2)};
  const PointSet set = make_point_set(cloud, "intensity");
  EXPECT_EQ(set.grid.offset, cloud.info.grid.offset);
  EXPECT_EQ(set.bounds, cloud.bounds);
  EXPECT_EQ(set.points[2].position, glm::ivec3(0, 0, 2));
  EXPECT_EQ(set.id(2), 2u);
}

TEST(ChooseColor, WithoutANameTakesRgbThenIntensityThenHeight) {
  EXPECT_EQ(choose_color({{.name = "intensity"}, {.name = "rgb"}}, ""), "rgb");
  EXPECT_EQ(choose_color({{.name = "gps-time"}, {.name = "intensity"}}, ""), "intensity");
  EXPECT_EQ(choose_color({{.name = "gps-time"}}, ""), "height");
  EXPECT_EQ(choose_color({}, "height"), "height");
  EXPECT_EQ(choose_color({{.name = "gps-time"}}, "gps-time"), "gps-time");
}

TEST(ChooseColor, AnUnknownNameIsWrongUsageAndListsWhatThereIs) {
  try {
    choose_color({{.name = "gps-time"}, {.name = "user data"}}, "colour");
    FAIL() << "no UsageError";
  } catch (const UsageError& e) {
    for (const char* part : {"--color colour", "height", "gps-time", "user data"})
      EXPECT_TRUE(contains(e.what(), part));
  }
}

TEST(ChooseColor, OnlyTheAttributeIsRead) {
  EXPECT_TRUE(attributes_for_color("height").empty());
  EXPECT_EQ(attributes_for_color("rgb"), Strings{"rgb"});
}

}  // namespace
}  // namespace stipple::test::measure_colorize
