// Every real LAZ file of the shared data, where they are there.
#include "octree/read/laz/laz_source.h"
#include "tests/read/laz_fixture.h"
#include "tests/read/shared_catalog.h"

namespace stipple::test::read_laz_catalog {
namespace {

using test::catalog_entries;
using test::CatalogEntry;
using test::contains;
using test::error_of;
using test::expect_equal;
using test::kSharedData;
using test::load_all;

class LazCatalog : public testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT_CATALOG(); }
};

TEST_F(LazCatalog, EveryFileHasThePointsThatTheCatalogSays) {
  std::size_t files = 0;
  for (const CatalogEntry& entry : catalog_entries({"LAZ ", "COPC "})) {
    if (!entry.count()) continue;
    SCOPED_TRACE(entry.path);
    const LazSource source(entry.full_path());
    EXPECT_EQ(source.info().point_count, entry.count());
    EXPECT_EQ(test::count_points(source), entry.count());
    EXPECT_TRUE(contains(entry.format, source.info().version));
    EXPECT_EQ(source.info().warnings, test::Strings{});
    ++files;
  }
  EXPECT_GE(files, 64u);
}

TEST_F(LazCatalog, EveryOtherFileIsAnErrorWithPathAndByte) {
  std::size_t files = 0;
  for (const CatalogEntry& entry : catalog_entries({"LAZ ", "COPC "})) {
    if (entry.points.find("header") == std::string::npos) continue;
    const std::string path = entry.full_path();
    EXPECT_TRUE(contains(error_of([&] { LazSource source(path); }), path + ": at byte "));
    ++files;
  }
  EXPECT_EQ(files, 4u);
}

TEST_F(LazCatalog, BoundsOfThePointsAreThoseOfTheHeader) {
  for (const char* path :
       {"PDAL+PDAL/laz/autzen_trim.laz", "PDAL+PDAL/laz/las_with_several_extra_byte_bloc.laz",
        "potree+potree/lion_takanawa.copc.laz", "visgl+loaders.gl/modules/las/test/data/indoor.laz"}) {
    SCOPED_TRACE(path);
    const Cloud cloud = load_cloud(LazSource((kSharedData / path).string()), {});
    const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(box.min[axis], cloud.info.stated_bounds.min[axis], cloud.info.grid.scale[axis]);
      EXPECT_NEAR(box.max[axis], cloud.info.stated_bounds.max[axis], cloud.info.grid.scale[axis]);
    }
  }
}

// Files that somebody compressed and kept. The two diamonds differ in the numbers of returns.
std::vector<std::array<std::string, 2>> twins() {
  std::vector<std::array<std::string, 2>> pairs;
  for (const CatalogEntry& entry : catalog_entries({"LAZ ", "COPC "})) {
    const std::string stem = entry.path.substr(0, entry.path.rfind('.'));
    if (stem.ends_with("diamond")) continue;
    for (const std::string& las : {stem, stem + ".las"})
      if (las.ends_with(".las") && std::filesystem::exists(kSharedData / las)) pairs.push_back({entry.path, las});
  }
  return pairs;
}

TEST_F(LazCatalog, FilesWithTheSameNameHaveTheSameValues) {
  const auto pairs = twins();
  for (const auto& [laz, las] : pairs) {
    SCOPED_TRACE(laz);
    expect_equal(load_all(*open_file((kSharedData / laz).string())),
                 load_all(*open_file((kSharedData / las).string())));
  }
  EXPECT_GE(pairs.size(), 20u);
}

TEST_F(LazCatalog, OldAndNewItemsOfTheSamePointsHaveTheSameValues) {
  const auto load = [](const char* path) { return load_all(*open_file((kSharedData / path).string())); };
  expect_equal(load("PDAL+PDAL/laz/simple-laszip-compressor-version-1.2r0.laz"), load("PDAL+PDAL/laz/simple.laz"));
}

}  // namespace
}  // namespace stipple::test::read_laz_catalog
