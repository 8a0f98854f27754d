// Every real LAS file of the shared data, where they are there.
#include <gtest/gtest.h>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "tests/octree/las_fixture.h"
#include "tests/read/shared_catalog.h"

namespace stipple::test::octree_las_catalog {
namespace {

using test::catalog_entries;
using test::CatalogEntry;
using test::contains;
using test::error_of;
using test::one_that_contains;
using test::Strings;

class LasCatalog : public ::testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT_CATALOG(); }

  static std::unique_ptr<PointSource> open(const std::string& path) {
    return open_source((test::kSharedData / path).string());
  }
};

std::size_t read_all(const PointSource& source) {
  std::vector<std::string> names;
  for (const Attribute& attribute : source.info().schema) names.push_back(attribute.name);
  return load_cloud(source, names).size();
}

TEST_F(LasCatalog, EveryFileHasThePointsThatTheCatalogSays) {
  std::size_t files = 0;
  for (const CatalogEntry& entry : catalog_entries({"LAS "})) {
    if (!entry.count()) continue;
    SCOPED_TRACE(entry.path);
    const auto source = open_source(entry.full_path());
    EXPECT_EQ(source->info().point_count, entry.count());
    EXPECT_EQ(read_all(*source), entry.count());
    ++files;
  }
  EXPECT_GT(files, 90u);
}

TEST_F(LasCatalog, EveryOtherFileIsAnErrorWithPathAndByte) {
  std::size_t files = 0;
  for (const CatalogEntry& entry : catalog_entries({"LAS "})) {
    if (entry.points.find("header") == std::string::npos) continue;
    EXPECT_TRUE(contains(error_of([&] { open_source(entry.full_path()); }), entry.full_path() + ": at byte "));
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
}  // namespace stipple::test::octree_las_catalog
