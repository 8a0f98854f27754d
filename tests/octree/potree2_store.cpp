#include "octree/store/potree2/potree2_store.h"

#include <gtest/gtest.h>

#include "octree/cloud/cloud.h"
#include "octree/store/tree_source.h"
#include "tests/octree/potree2_files.h"

namespace stipple::test::octree_potree2_store {
namespace {

using test::contains;
using test::error_of;
using test::put;
using test::ScratchFolder;
using test::TreeFiles;
using test::TreePoint;

std::vector<TreePoint> points_of(const Cloud& cloud) {
  std::vector<TreePoint> points(cloud.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].position = cloud.positions[i];
    points[i].intensity = cloud.find("intensity")->as<std::uint16_t>()[i];
    for (int c = 0; c < 3; ++c) points[i].rgb[c] = cloud.find("rgb")->as<std::uint16_t>()[3 * i + c];
    points[i].classification = cloud.find("classification")->as<std::uint8_t>()[i];
  }
  return points;
}

std::vector<TreePoint> read_all(const std::string& path) {
  // Not the order of the file: columns have to come as asked for
  return points_of(load_cloud(*open_source(path), {"classification", "rgb", "intensity"}));
}

class Potree2Encoding : public testing::TestWithParam<const char*> {};

TEST_P(Potree2Encoding, EveryPointIsReadAsItWasWritten) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual(GetParam());
  EXPECT_EQ(read_all(files.write(folder)), files.all_points());
}

TEST_P(Potree2Encoding, PositionsKeepAllTheirBits) {
  const ScratchFolder folder;
  TreeFiles files;
  files.encoding = GetParam();
  files.nodes["r"] = {{{std::numeric_limits<int>::max(), std::numeric_limits<int>::min(), -1}},
                      {{0x12345678, 0x0000FFFF, 0x00010000}},
                      {{1 << 30, 1 << 27, 1 << 21}}};
  EXPECT_EQ(read_all(files.write(folder)), files.all_points());
}

TEST_P(Potree2Encoding, OneAttributeComesWithoutTheOthers) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual(GetParam());
  const auto store = open_tree(files.write(folder));
  const auto rgb = find_attribute(store->info().source.schema, "rgb");
  ASSERT_TRUE(rgb);
  PointBatch batch;
  store->read_points(store->root_piece().nodes[0], std::array{*rgb}, batch);
  ASSERT_EQ(batch.columns.size(), 1u);
  EXPECT_EQ(batch.columns[0].attribute.name, "rgb");
  EXPECT_EQ(batch.columns[0].as<std::uint16_t>()[3 * 59 + 1], files.nodes.at("r")[59].rgb[1]);
}

INSTANTIATE_TEST_SUITE_P(All, Potree2Encoding, testing::Values("DEFAULT", "UNCOMPRESSED", "BROTLI"));

TEST(Potree2Store, WithoutAnEncodingNodesAreRecords) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual();
  files.write(folder);
  Json metadata = files.metadata();
  metadata.erase("encoding");
  folder.write("metadata.json", TreeFiles::bytes_of(metadata));
  EXPECT_EQ(read_all(folder.path("")), files.all_points());
}

TEST(Potree2Store, OpeningReadsTheFirstPieceAlone) {
  const ScratchFolder folder;
  const auto store = open_tree(TreeFiles::usual().write(folder));
  const auto piece = store->root_piece();
  ASSERT_EQ(piece.nodes.size(), 4u);
  EXPECT_EQ(name_of(piece.nodes[0]), "r");
  EXPECT_EQ(name_of(piece.nodes[2]), "r3");
  ASSERT_EQ(piece.continued.size(), 2u);
  EXPECT_EQ(name_of(piece.nodes[piece.continued[1].node]), "r7");
}

TEST(Potree2Store, APieceGoesOnWhereTheProxyIs) {
  const ScratchFolder folder;
  const auto store = open_tree(TreeFiles::usual().write(folder));
  const auto first = store->root_piece();
  const auto next = store->read_piece(first.continued[1], first.nodes[first.continued[1].node]);
  ASSERT_EQ(next.nodes.size(), 2u);
  EXPECT_EQ(name_of(next.nodes[0]), "r7");
  EXPECT_EQ(name_of(next.nodes[1]), "r70");
  EXPECT_EQ(next.nodes[1].parent, 0u);
}

TEST(Potree2Store, TheWholeHierarchyIsLinkedBothWays) {
  const ScratchFolder folder;
  const auto nodes = read_whole_hierarchy(*open_tree(TreeFiles::usual().write(folder)));
  ASSERT_EQ(nodes.size(), 6u);
  for (std::uint32_t i = 1; i < nodes.size(); ++i) {
    ASSERT_LT(nodes[i].parent, i);
    EXPECT_EQ(nodes[nodes[i].parent].children[name_of(nodes[i]).back() - '0'], i);
    EXPECT_EQ(name_of(nodes[i]).substr(0, name_of(nodes[i]).size() - 1), name_of(nodes[nodes[i].parent]));
  }
}

TEST(Potree2Store, ATreeIsItsFolderOrItsMetadata) {
  const ScratchFolder folder;
  TreeFiles::usual().write(folder);
  EXPECT_TRUE(is_tree(folder.path("")));
  EXPECT_TRUE(is_tree(folder.path("metadata.json")));
  EXPECT_FALSE(is_tree(folder.path("octree.bin")));
  EXPECT_FALSE(is_tree(folder.path("nothing")));
  EXPECT_EQ(read_all(folder.path("metadata.json")).size(), 360u);
}

TEST(Potree2Store, AFolderThatIsNoTreeSaysWhatATreeIs) {
  const ScratchFolder folder;
  EXPECT_TRUE(contains(error_of([&] { open_tree(folder.path("")); }), "is no octree that is read"));
}

TEST(Potree2Store, AMissingFileIsNamed) {
  for (const char* name : {"hierarchy.bin", "octree.bin"}) {
    const ScratchFolder folder;
    TreeFiles::usual().write(folder);
    std::filesystem::remove(folder.path(name));
    EXPECT_TRUE(contains(error_of([&] { open_tree(folder.path("")); }), std::string(name) + ": there is no such file"));
  }
}

TEST(Potree2Store, InfoSaysWhatTheMetadataSay) {
  const ScratchFolder folder;
  const auto store = open_tree(TreeFiles::usual("BROTLI").write(folder));
  const TreeInfo& info = store->info();
  EXPECT_EQ(info.source.point_count, 360u);
  EXPECT_EQ(info.source.schema.size(), 3u);
  EXPECT_EQ(info.cube.edge, 1024.0);
  EXPECT_EQ(info.spacing, 8.0);
  EXPECT_EQ(info.source.stated_bounds.max, glm::dvec3(1124.0, 1224.0, 1324.0));
  EXPECT_TRUE(info.source.encoding.starts_with("brotli"));
  EXPECT_FALSE(info.minimal_distance);
  EXPECT_FALSE(info.has_details);
}

TEST(Potree2Store, ANodeOfNoBytesHasNoPointsWhateverItsCountSays) {
  const ScratchFolder folder;
  TreeFiles files = TreeFiles::usual();
  files.nodes["r3"].clear();
  files.write(folder);
  test::Bytes hierarchy = files.hierarchy();
  put(hierarchy, files.record_offset("r3") + 2, std::uint32_t{17});
  folder.write("hierarchy.bin", hierarchy);
  EXPECT_EQ(read_all(folder.path("")).size(), 300u);
}

TEST(Potree2Store, ATreeOfNoPointsHasNoBounds) {
  const ScratchFolder folder;
  TreeFiles files;
  files.nodes["r"] = {};
  EXPECT_EQ(read_all(files.write(folder)).size(), 0u);
  EXPECT_TRUE(open_tree(folder.path(""))->info().source.stated_bounds.empty());
}

TEST(TreeSource, IdsLeadToTheirNodes) {
  const ScratchFolder folder;
  const TreeSource source(open_tree(TreeFiles::usual().write(folder)));
  EXPECT_EQ(name_of(source.node_of(0)), "r");
  EXPECT_EQ(name_of(source.node_of(59)), "r");
  EXPECT_EQ(name_of(source.node_of(60)), "r0");
  EXPECT_EQ(name_of(source.node_of(359)), "r70");
}

TEST(TreeSource, FewerPointsThanStatedAreAWarning) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual();
  files.write(folder);
  Json metadata = files.metadata();
  metadata["points"] = 400;
  folder.write("metadata.json", TreeFiles::bytes_of(metadata));
  const auto source = open_source(folder.path(""));
  EXPECT_EQ(source->info().point_count, 360u);
  EXPECT_TRUE(test::one_that_contains(source->info().warnings, "state 400 points, and the nodes hold 360"));
}

TEST(TreeSource, MorePointsThanStatedAreAnError) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual();
  files.write(folder);
  Json metadata = files.metadata();
  metadata["points"] = 300;
  folder.write("metadata.json", TreeFiles::bytes_of(metadata));
  EXPECT_TRUE(contains(error_of([&] { open_source(folder.path("")); }), "hold 360 points, and the metadata state 300"));
}

}  // namespace
}  // namespace stipple::test::octree_potree2_store
