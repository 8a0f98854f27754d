#include "render/store/colorist.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "octree/cloud/columns.h"
#include "octree/core/error.h"
#include "octree/open/open.h"
#include "tests/command/run_stipple.h"

namespace stipple::test::measure_colorist {
namespace {

constexpr std::uint64_t kPoints = 20'000;

// A city as a LAS file, which has all attributes of one. Notes what is read of it.
struct City {
  ScratchFolder folder;
  std::unique_ptr<PointSource> source = open_source(city_file(folder, kPoints));
  std::vector<std::string> read;

  std::vector<Column> columns(const std::vector<std::string>& attributes) {
    read.insert(read.end(), attributes.begin(), attributes.end());
    return load_columns(*source, attributes);
  }
};

std::vector<std::string> all_colors(const Schema& schema) {
  std::vector<std::string> names{"height"};
  for (const Attribute& attribute : schema) names.push_back(attribute.name);
  return names;
}

ClassSet classes(std::initializer_list<std::size_t> numbers) {
  ClassSet set;
  for (const std::size_t number : numbers) set.set(number);
  return set;
}

class ColoristTest : public testing::Test {
 protected:
  void color(const ColorChoice& choice) {
    const auto read = [this](const std::vector<std::string>& attributes) { return city_.columns(attributes); };
    dataset_ = recolored(dataset_, colorist_.color(dataset_, choice, read));
  }
  // As if it had been loaded in these colours.
  void expect(const ColorChoice& choice) const {
    Dataset loaded = load_dataset(*city_.source, choice, {.octree = true});
    EXPECT_EQ(dataset_.colors, loaded.colors) << choice.attribute;
    EXPECT_EQ(hash_points(dataset_.points), hash_points(loaded.points)) << choice.attribute;
  }

  City city_;
  Dataset dataset_ = load_dataset(*city_.source, {}, {.octree = true});
  Colorist colorist_;
};

TEST_F(ColoristTest, ColoursByEveryAttributeAsLoadingDoes) {
  for (const std::string& name : all_colors(city_.source->info().schema)) {
    color(name);
    expect(name);
    color({name, Ramp::turbo, classes({6})});
    expect({name, Ramp::turbo, classes({6})});
  }
}

TEST_F(ColoristTest, ReadsNothingTwiceAndNothingForHeights) {
  color("height");
  color({"height", Ramp::magma});
  expect({"height", Ramp::magma});
  EXPECT_EQ(city_.read, std::vector<std::string>{});
  color("return number");
  color({"return number", Ramp::magma});
  expect({"return number", Ramp::magma});
  EXPECT_EQ(city_.read, std::vector<std::string>{"return number"});
  // Another ramp does not change greys
  color("intensity");
  color({"intensity", Ramp::viridis});
  EXPECT_EQ(city_.read.size(), 2u);
}

TEST_F(ColoristTest, HidesClassesAndShowsThemAgainInTheirColours) {
  const std::uint64_t before = hash_points(dataset_.points);
  const std::string attribute = dataset_.colors.attribute;
  color({attribute, Ramp::viridis, classes({2})});
  expect({attribute, Ramp::viridis, classes({2})});
  color({attribute, Ramp::viridis, classes({2, 6})});
  expect({attribute, Ramp::viridis, classes({2, 6})});
  color({"classification", Ramp::viridis, classes({6})});
  expect({"classification", Ramp::viridis, classes({6})});
  color(attribute);
  EXPECT_EQ(hash_points(dataset_.points), before);
  EXPECT_EQ(std::ranges::count(city_.read, std::string(kClassAttribute)), 1);
}

TEST_F(ColoristTest, RefusesPointsThatAreNotNumberedFromZero) {
  dataset_.points.ids.front() = kPoints;
  EXPECT_THROW(color("height"), Error);
}

}  // namespace
}  // namespace stipple::test::measure_colorist
