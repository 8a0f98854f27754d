// Every EPT and Potree 1 tree of the shared data, where they are there.
#include <gtest/gtest.h>

#include "octree/store/tree_source.h"
#include "src/check/check_tree.h"
#include "src/check/compare_points.h"
#include "tests/octree/node_files.h"
#include "tests/read/shared_catalog.h"

namespace stipple::test::octree_node_files_catalog {
namespace {

namespace fs = std::filesystem;
using test::catalog_entries;
using test::CatalogEntry;
using test::contains;
using test::error_of;
using test::kSharedData;

bool is_malformed(const CatalogEntry& entry) {
  return entry.note.find("MALFORMED") != std::string::npos;
}

std::uint64_t points_in_nodes(const TreeStore& store) {
  std::uint64_t points = 0;
  for (const StoredNode& node : locate_all(store, read_whole_hierarchy(store))) points += node.points;
  return points;
}

class NodeFilesCatalog : public testing::Test {
 protected:
  void SetUp() override { SKIP_WITHOUT_CATALOG(); }
};

TEST_F(NodeFilesCatalog, EveryTreeHasThePointsThatTheCatalogSays) {
  std::size_t trees = 0;
  for (const CatalogEntry& entry : catalog_entries({"EPT ", "Potree 1."})) {
    if (is_malformed(entry)) continue;
    SCOPED_TRACE(entry.path);
    ++trees;
    const auto store = open_tree(entry.full_path());
    EXPECT_TRUE(entry.format.starts_with(store->info().source.format + " " + store->info().source.version));
    EXPECT_EQ(points_in_nodes(*store), std::stoull(entry.points));
  }
  EXPECT_GE(trees, 9u);
}

TEST_F(NodeFilesCatalog, EveryTreeIsWholeAndWithinItsBounds) {
  for (const CatalogEntry& entry : catalog_entries({"EPT ", "Potree 1."})) {
    if (is_malformed(entry)) continue;
    SCOPED_TRACE(entry.path);
    const std::string path = entry.full_path();
    const TreeReport report = check_tree(*open_tree(path));
    EXPECT_EQ(report.points, std::stoull(entry.points));
    if (entry.path.find("bcbf") != std::string::npos) {
      ASSERT_TRUE(report.defect);
      EXPECT_EQ(report.defect->what, "the metadata state 10 points, and the nodes hold 5");
    } else {
      EXPECT_FALSE(report.defect) << report.defect->node << ": " << report.defect->what;
    }
    const Cloud cloud = load_cloud(*open_source(path), {});
    const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
    const WorldBox& stated = cloud.info.stated_bounds;
    for (int axis = 0; axis < 3; ++axis) {
      // Points are rounded to their grid, and were after their bounds were taken
      const double tolerance = 0.001 + 0.5 * cloud.info.grid.scale[axis];
      EXPECT_GE(box.min[axis], stated.min[axis] - tolerance);
      EXPECT_LE(box.max[axis], stated.max[axis] + tolerance);
    }
    // EPT rounds its bounds outwards to whole units
    if (entry.format.starts_with("EPT")) continue;
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_NEAR(box.min[axis], stated.min[axis], 0.0015);
      EXPECT_NEAR(box.max[axis], stated.max[axis], 0.0015);
    }
  }
}

TEST_F(NodeFilesCatalog, MalformedTreesSayWhatIsWrong) {
  const std::string ept = (kSharedData / "PDAL+PDAL/ept/").string();
  const std::string count = error_of([&] { open_source(ept + "bad-pointcount/laszip"); });
  EXPECT_TRUE(contains(count, "ept-data/0-0-0-0.laz: the header states 1065 points, and the 1000 points of node"));
  const std::string missing = error_of([&] { open_source(ept + "ellipsoid-nopoints"); });
  EXPECT_TRUE(contains(missing, "ept-data/0-0-0-0.bin: there is no such file, and the 100000 points of node"));
  const TreeSource source(open_tree(ept + "bcbf"));
  EXPECT_EQ(source.info().point_count, 5u);
  EXPECT_TRUE(test::one_that_contains(source.info().warnings, "the metadata state 10 points, and the nodes hold 5"));
}

void expect_same(const std::string& tree, const std::string& other, std::size_t attributes) {
  SCOPED_TRACE(tree + " and " + other);
  std::vector<std::unique_ptr<PointSource>> others;
  others.push_back(open_source((kSharedData / other).string()));
  const Comparison comparison = compare_points(TreeSource(open_tree((kSharedData / tree).string())), others);
  EXPECT_FALSE(comparison.defect) << comparison.defect->what;
  EXPECT_EQ(comparison.largest_rounding, 0.0);
  EXPECT_GE(comparison.compared.size(), attributes);
}

TEST_F(NodeFilesCatalog, OneCloudInSeveralFormatsIsOneCloud) {
  expect_same("potree+potree/lion_takanawa_ept_bin", "potree+potree/lion_takanawa_ept_laz", 11);
  expect_same("potree+potree/lion_takanawa_ept_bin", "potree+potree/lion_takanawa_laz", 10);
  expect_same("PDAL+PDAL/ept/1.2-with-color", "PDAL+PDAL/las/1.2-with-color.las", 8);
}

// As Zstandard packs them: the catalogue has no such tree.
TEST_F(NodeFilesCatalog, TheLionPackedByZstandardIsTheLion) {
  const test::ScratchFolder folder;
  const fs::path lion = kSharedData / "potree+potree/lion_takanawa_ept_bin";
  Json metadata = Json::parse(std::ifstream(lion / "ept.json"));
  metadata["dataType"] = "zstandard";
  test::write_bytes(folder.path("ept.json"), test::TreeFiles::bytes_of(metadata));
  fs::copy(lion / "ept-hierarchy", folder.path("ept-hierarchy"), fs::copy_options::recursive);
  for (const auto& node : fs::directory_iterator(lion / "ept-data"))
    test::write_bytes(folder.path("ept-data/" + node.path().stem().string() + ".zst"),
                      test::zstandard(test::read_bytes(node.path())));
  expect_same("potree+potree/lion_takanawa_ept_bin", folder.path(""), 11);
}

}  // namespace
}  // namespace stipple::test::octree_node_files_catalog
