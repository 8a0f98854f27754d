// Every real LAZ file of the shared data, where they are there.
#include <charconv>
#include <sstream>

#include "octree/read/laz/laz_source.h"
#include "tests/read/laz_fixture.h"

namespace stipple {
namespace {

using test::contains;
using test::error_of;
using test::expect_equal;
using test::load_all;

const std::filesystem::path kData = STIPPLE_SHARED_DATA;

struct Entry {
  std::string path;
  std::string format;
  std::string points;  // a number, or a number and a remark
};

std::vector<Entry> laz_entries() {
  std::vector<Entry> entries;
  std::ifstream catalog(kData / "catalog.tsv");
  for (std::string line; std::getline(catalog, line);) {
    std::istringstream columns(line);
    Entry entry;
    std::string source;
    std::getline(columns, entry.path, '\t');
    std::getline(columns, source, '\t');
    std::getline(columns, entry.format, '\t');
    std::getline(columns, entry.points, '\t');
    if (entry.format.starts_with("LAZ ") || entry.format.starts_with("COPC ")) entries.push_back(entry);
  }
  return entries;
}

class LazCatalog : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kData / "catalog.tsv")) GTEST_SKIP() << "no shared data at " << kData;
  }
};

TEST_F(LazCatalog, EveryFileHasThePointsThatTheCatalogSays) {
  std::size_t files = 0;
  for (const Entry& entry : laz_entries()) {
    std::uint64_t points = 0;
    const auto [end, error] = std::from_chars(entry.points.data(), entry.points.data() + entry.points.size(), points);
    if (error != std::errc() || end != entry.points.data() + entry.points.size()) continue;
    SCOPED_TRACE(entry.path);
    const LazSource source((kData / entry.path).string());
    EXPECT_EQ(source.info().point_count, points);
    EXPECT_EQ(test::count_points(source), points);
    EXPECT_TRUE(contains(entry.format, source.info().version));
    EXPECT_EQ(source.info().warnings, test::Strings{});
    ++files;
  }
  EXPECT_GE(files, 64u);
}

TEST_F(LazCatalog, EveryOtherFileIsAnErrorWithPathAndByte) {
  std::size_t files = 0;
  for (const Entry& entry : laz_entries()) {
    if (entry.points.find("header") == std::string::npos) continue;
    const std::string path = (kData / entry.path).string();
    EXPECT_TRUE(contains(error_of([&] { LazSource source(path); }), path + ": at byte "));
    ++files;
  }
  EXPECT_EQ(files, 4u);
}

TEST_F(LazCatalog, BoundsOfThePointsAreThoseOfTheHeader) {
  for (const char* path :
       {"derived/autzen-stadium.laz", "PDAL+PDAL/laz/las_with_several_extra_byte_bloc.laz",
        "potree+potree/lion_takanawa.copc.laz", "visgl+loaders.gl/modules/las/test/data/indoor.laz"}) {
    SCOPED_TRACE(path);
    const Cloud cloud = load_cloud(LazSource((kData / path).string()), {});
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
  for (const Entry& entry : laz_entries()) {
    const std::string stem = entry.path.substr(0, entry.path.rfind('.'));
    if (stem.ends_with("diamond")) continue;
    for (const std::string& las : {stem, stem + ".las"})
      if (las.ends_with(".las") && std::filesystem::exists(kData / las)) pairs.push_back({entry.path, las});
  }
  return pairs;
}

TEST_F(LazCatalog, FilesWithTheSameNameHaveTheSameValues) {
  const auto pairs = twins();
  for (const auto& [laz, las] : pairs) {
    SCOPED_TRACE(laz);
    expect_equal(load_all(*open_file((kData / laz).string())), load_all(*open_file((kData / las).string())));
  }
  EXPECT_GE(pairs.size(), 20u);
}

TEST_F(LazCatalog, OldAndNewItemsOfTheSamePointsHaveTheSameValues) {
  const auto load = [](const char* path) { return load_all(*open_file((kData / path).string())); };
  expect_equal(load("PDAL+PDAL/laz/simple-laszip-compressor-version-1.2r0.laz"), load("PDAL+PDAL/laz/simple.laz"));
}

}  // namespace
}  // namespace stipple
