// Every real LAS file of the shared data, where they are there.
#include <gtest/gtest.h>

#include <charconv>
#include <sstream>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "tests/octree/las_fixture.h"

namespace stipple {
namespace {

using test::contains;
using test::error_of;
using test::one_that_contains;
using test::Strings;

const std::filesystem::path kData = STIPPLE_SHARED_DATA;

struct Entry {
  std::string path;
  std::string points;  // a number, or a number and a remark
};

std::vector<Entry> las_entries() {
  std::vector<Entry> entries;
  std::ifstream catalog(kData / "catalog.tsv");
  for (std::string line; std::getline(catalog, line);) {
    std::istringstream columns(line);
    std::string path, source, format, points;
    std::getline(columns, path, '\t');
    std::getline(columns, source, '\t');
    std::getline(columns, format, '\t');
    std::getline(columns, points, '\t');
    if (format.starts_with("LAS ")) entries.push_back({(kData / path).string(), points});
  }
  return entries;
}

class LasCatalog : public ::testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kData / "catalog.tsv")) GTEST_SKIP() << "no shared data at " << kData;
  }

  static std::unique_ptr<PointSource> open(const std::string& path) { return open_source((kData / path).string()); }
};

std::size_t read_all(const PointSource& source) {
  std::vector<std::string> names;
  for (const Attribute& attribute : source.info().schema) names.push_back(attribute.name);
  return load_cloud(source, names).size();
}

TEST_F(LasCatalog, EveryFileHasThePointsThatTheCatalogSays) {
  std::size_t files = 0;
  for (const Entry& entry : las_entries()) {
    std::uint64_t points = 0;
    const auto [end, error] = std::from_chars(entry.points.data(), entry.points.data() + entry.points.size(), points);
    if (error != std::errc() || end != entry.points.data() + entry.points.size()) continue;
    SCOPED_TRACE(entry.path);
    const auto source = open_source(entry.path);
    EXPECT_EQ(source->info().point_count, points);
    EXPECT_EQ(read_all(*source), points);
    ++files;
  }
  EXPECT_GT(files, 90u);
}

TEST_F(LasCatalog, EveryOtherFileIsAnErrorWithPathAndByte) {
  std::size_t files = 0;
  for (const Entry& entry : las_entries()) {
    if (entry.points.find("header") == std::string::npos) continue;
    EXPECT_TRUE(contains(error_of([&] { open_source(entry.path); }), entry.path + ": at byte "));
    ++files;
  }
  EXPECT_EQ(files, 3u);
}

TEST_F(LasCatalog, StatedBoundsHoldThePointsOfAutzen) {
  const auto source = open("PDAL+PDAL/las/autzen_trim_7.las");
  const Cloud cloud = load_cloud(*source, {});
  const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min[axis], cloud.info.stated_bounds.min[axis], 0.005);
    EXPECT_NEAR(box.max[axis], cloud.info.stated_bounds.max[axis], 0.005);
  }
}

TEST_F(LasCatalog, AClippedFileIsAnErrorThatCountsTheWholePoints) {
  EXPECT_TRUE(contains(error_of([] { open("PDAL+PDAL/las/1.2-with-color-clipped.las"); }),
                       "at byte 36405: the file ends here, with 1064 of the 1065 points"));
}

TEST_F(LasCatalog, AWrongNumberOfVlrsIsAWarning) {
  EXPECT_TRUE(
      one_that_contains(open("PDAL+PDAL/las/bad_vlr_count.las")->info().warnings, "states 3 variable length records"));
}

TEST_F(LasCatalog, ADescriptionOfExtraBytesThatAreNotThereIsAWarning) {
  const auto source = open("r-lidar+lasR/extdata/malformed_extrabytes.las");
  EXPECT_TRUE(one_that_contains(source->info().warnings, "\"TestEB\" takes 2 bytes, and 0 of the record are left"));
  EXPECT_FALSE(find_attribute(source->info().schema, "extra bytes"));
}

TEST_F(LasCatalog, ExtraBytesRepeatTheFieldsTheyWereCopiedFrom) {
  const auto source = open("PDAL+PDAL/las/extrabytes.las");
  EXPECT_EQ(source->info().warnings, Strings{});
  const Cloud cloud = load_cloud(*source, {"rgb", "Colors", "intensity", "Intensity", "gps-time", "Time"});
  ASSERT_EQ(cloud.columns.size(), 6u);
  EXPECT_EQ(cloud.find("Colors")->bytes, cloud.find("rgb")->bytes);
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_EQ(value_at(*cloud.find("Intensity"), i), value_at(*cloud.find("intensity"), i));
    ASSERT_EQ(value_at(*cloud.find("Time"), i), std::floor(value_at(*cloud.find("gps-time"), i)));
  }
}

TEST_F(LasCatalog, ScaledExtraBytesHaveTheirScale) {
  const auto source = open("LASzip+LASzip/example/5points_14.las");
  const auto index = find_attribute(source->info().schema, "height above ground");
  ASSERT_TRUE(index);
  EXPECT_EQ(source->info().schema[*index], (Attribute{"height above ground", ScalarType::i16, 1, 0.05}));
}

TEST_F(LasCatalog, UnregisteredExtraBytesAreOneColumn) {
  const auto source = open("laspy+laspy/data/unregistered_extra_bytes.las");
  EXPECT_EQ(source->info().schema.back(), (Attribute{"extra bytes", ScalarType::u8, 4}));
}

}  // namespace
}  // namespace stipple
