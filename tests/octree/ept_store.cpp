#include "octree/store/ept/ept_store.h"

#include <gtest/gtest.h>

#include <chrono>
#include <cmath>

#include "octree/store/tree_source.h"
#include "src/check/check_tree.h"
#include "tests/octree/node_files.h"

namespace stipple::test::octree_ept_store {
namespace {

using test::Bytes;
using test::contains;
using test::EptFiles;
using test::error_of;
using test::points_in_steps;
using test::put;
using test::ScratchFolder;
using test::sorted;
using test::TreeFiles;
using test::write_bytes;

const std::vector<std::string> kAttributes{"classification", "rgb", "intensity"};

class EptType : public testing::TestWithParam<const char*> {
 protected:
  EptType() { files_.data_type = GetParam(); }
  EptFiles files_;
  ScratchFolder folder_;
};

TEST_P(EptType, EveryPointIsReadAsItWasWritten) {
  const Cloud cloud = load_cloud(*open_source(files_.write(folder_)), kAttributes);
  EXPECT_EQ(sorted(points_in_steps(cloud)), sorted(files_.tree.all_points()));
}

TEST_P(EptType, TheTreeIsWhole) {
  const TreeReport report = check_tree(*open_tree(files_.write(folder_)));
  EXPECT_FALSE(report.defect) << report.defect->node << ": " << report.defect->what;
  EXPECT_EQ(report.nodes, 6u);
  EXPECT_EQ(report.points, 360u);
}

TEST_P(EptType, PartsAreSlicesOfTheWhole) {
  const auto store = open_tree(files_.write(folder_));
  const StoredNode root = store->locate(store->root_piece().nodes[0]);
  PointBatch whole, part;
  const std::array<std::size_t, 2> both{0, 1};
  store->read_points(root, both, whole);
  store->read_part(root, 7, 20, both, part);
  ASSERT_EQ(part.positions.size(), 20u);
  EXPECT_TRUE(std::equal(part.positions.begin(), part.positions.end(), whole.positions.begin() + 7));
  for (std::size_t c = 0; c < 2; ++c) {
    const auto each = static_cast<std::ptrdiff_t>(whole.columns[c].attribute.bytes());
    EXPECT_TRUE(std::equal(part.columns[c].bytes.begin(), part.columns[c].bytes.end(),
                           whole.columns[c].bytes.begin() + 7 * each));
  }
}

TEST_P(EptType, AMissingNodeIsNamed) {
  files_.write(folder_);
  std::filesystem::remove(folder_.path(EptFiles::node_file("r7", GetParam())));
  const std::string message = error_of([&] { open_source(folder_.path("")); });
  EXPECT_TRUE(contains(message, EptFiles::node_file("r7", GetParam()) + ": there is no such file"));
  EXPECT_TRUE(contains(message, "the 60 points of node 1-1-1-1"));
}

TEST_P(EptType, ANodeOfAnotherSizeIsNamed) {
  files_.write(folder_);
  Bytes bytes = EptFiles::rows(files_.tree.nodes.at("r7"));
  bytes.resize(bytes.size() - 21);
  write_bytes(folder_.path(EptFiles::node_file("r7", GetParam())),
              files_.data_type == "zstandard" ? test::zstandard(bytes) : bytes);
  const std::string message = error_of([&] { open_source(folder_.path("")); });
  EXPECT_TRUE(contains(message, EptFiles::node_file("r7", GetParam())));
  EXPECT_TRUE(contains(message, "1239 bytes, which at 21 bytes a point is not 1260"));
  EXPECT_EQ(check_tree(*open_tree(folder_.path(""))).defect->node, "r7");
}

INSTANTIATE_TEST_SUITE_P(All, EptType, testing::Values("binary", "zstandard"));

TEST(EptStore, SaysWhatItIs) {
  const ScratchFolder folder;
  const EptFiles files;
  EXPECT_TRUE(is_tree(files.write(folder)));
  EXPECT_TRUE(is_tree(folder.path("ept.json")));
  EXPECT_FALSE(is_tree(folder.path("ept-data/0-0-0-0.bin")));
  const TreeInfo info = open_tree(folder.path("ept.json"))->info();
  EXPECT_EQ(info.source.format, "EPT");
  EXPECT_EQ(info.source.version, "1.1.0");
  EXPECT_EQ(info.source.encoding, "binary, 21 bytes a point");
  EXPECT_EQ(info.source.point_count, 360u);
  EXPECT_EQ(info.spacing, 8.0);
  EXPECT_EQ(info.cube.edge, 1024.0);
  EXPECT_EQ(info.source.grid.scale, glm::dvec3(0.5));
  EXPECT_TRUE(info.node_files);
}

TEST(EptStore, OpeningReadsTheFirstPageAlone) {
  const ScratchFolder folder;
  EptFiles files;
  files.write(folder);
  std::filesystem::remove_all(folder.path("ept-data"));
  for (const auto& [key, page] : files.pages())
    if (key != "0-0-0-0") std::filesystem::remove(folder.path("ept-hierarchy/" + key + ".json"));
  const auto store = open_tree(folder.path(""));
  EXPECT_EQ(store->root_piece().nodes.size(), 4u);
  EXPECT_EQ(store->root_piece().continued.size(), 2u);
  EXPECT_LT(store->bytes_read(), 3000u);
}

TEST(EptStore, NodesThatAreOnlyImpliedHoldNothing) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree.nodes.erase("r");
  files.levels_a_page = 9;
  const Cloud cloud = load_cloud(*open_source(files.write(folder)), kAttributes);
  EXPECT_EQ(sorted(points_in_steps(cloud)), sorted(files.tree.all_points()));
  const std::vector<StoredNode> begin = uppermost_nodes(*open_tree(folder.path("")));
  ASSERT_EQ(begin.size(), 3u);
  EXPECT_EQ(begin.front().level, 1);
}

TEST(EptStore, TwoDimensionsOfOneMeaningKeepTwoNames) {
  const ScratchFolder folder;
  const EptFiles files;
  Json metadata = files.metadata();
  metadata["schema"][3]["name"] = "ScanAngle";
  metadata["schema"][7]["name"] = "ScanAngleRank";
  files.write(folder);
  write_bytes(folder.path("ept.json"), TreeFiles::bytes_of(metadata));
  const Schema schema = open_tree(folder.path(""))->info().source.schema;
  EXPECT_TRUE(find_attribute(schema, "scan angle"));
  EXPECT_TRUE(find_attribute(schema, "ScanAngleRank"));
}

// One node whose X, Y and Z have a type of their own.
template <class T>
void expect_positions(const char* type, const std::vector<glm::dvec3>& points, double scale, double tolerance) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree.nodes = {{"r", std::vector<test::TreePoint>(points.size())}};
  Json metadata = files.metadata();
  Json schema = Json::array();
  Bytes rows;
  for (int axis = 0; axis < 3; ++axis) {
    schema.push_back({{"name", std::string(1, "XYZ"[axis])}, {"type", type}, {"size", sizeof(T)}});
    if (scale != 1.0) schema.back()["scale"] = scale;
  }
  metadata["schema"] = schema;
  files.write(folder);
  write_bytes(folder.path("ept.json"), TreeFiles::bytes_of(metadata));
  for (const glm::dvec3& point : points)
    for (int axis = 0; axis < 3; ++axis)
      put(rows, rows.size(), static_cast<T>(std::is_integral_v<T> ? std::round(point[axis] / scale) : point[axis]));
  write_bytes(folder.path("ept-data/0-0-0-0.bin"), rows);
  const Cloud cloud = load_cloud(*open_source(folder.path("")), {});
  ASSERT_EQ(cloud.size(), points.size());
  for (std::size_t i = 0; i < points.size(); ++i) {
    const glm::dvec3 world = cloud.info.grid.world_from_grid(cloud.positions[i]);
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(world[axis], points[i][axis], tolerance) << type << sizeof(T);
  }
}

TEST(EptStore, PositionsOfAnyTypeKeepTheirPlace) {
  const std::vector<glm::dvec3> whole{{100, 200, 300}, {1124, 1224, 1324}, {555, 777, 999}};
  expect_positions<std::uint16_t>("unsigned", whole, 1.0, 0.0);
  expect_positions<std::int16_t>("signed", whole, 1.0, 0.0);
  expect_positions<std::uint32_t>("unsigned", whole, 1.0, 0.0);
  // From 0, these would not fit the grid's 32 bits
  expect_positions<std::int64_t>("signed", whole, 1e-6, 1e-9);
  expect_positions<std::uint64_t>("unsigned", whole, 1e-6, 1e-9);
  const std::vector<glm::dvec3> real{{100.125, 200.0625, 300.5}, {1123.9375, 1000.5, 1234.75}};
  expect_positions<float>("float", real, 1.0, 0.0);
  expect_positions<double>("float", real, 1.0, 0.0);
  expect_positions<double>("float", {{100.1, 987.654321, 1e3 + 1e-6}}, 1.0, 1024.0 / (1 << 30));
}

TEST(EptStore, APositionBeyondTheGridIsAnError) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree.nodes = {{"r", std::vector<test::TreePoint>(1)}};
  Json metadata = files.metadata();
  for (int axis = 0; axis < 3; ++axis)
    metadata["schema"][axis] = {{"name", std::string(1, "XYZ"[axis])}, {"type", "unsigned"}, {"size", 8}};
  files.write(folder);
  write_bytes(folder.path("ept.json"), TreeFiles::bytes_of(metadata));
  for (const std::uint64_t value : {~std::uint64_t{0}, ~std::uint64_t{0} - 5, std::uint64_t{1} << 40}) {
    Bytes row(3 * 8 + 9);
    put(row, 8, value);
    write_bytes(folder.path("ept-data/0-0-0-0.bin"), row);
    const auto store = open_tree(folder.path(""));
    PointBatch batch;
    const std::string message =
        error_of([&] { store->read_points(store->locate(store->root_piece().nodes[0]), {}, batch); });
    EXPECT_TRUE(contains(message, "ept-data/0-0-0-0.bin: y of its point 0 is too far from the tree's cube"));
  }
}

struct Wrong {
  const char* what;
  std::function<void(Json&)> change;
  const char* message;
};

TEST(EptStore, WhatIsWrongInTheMetadataIsNamed) {
  const Wrong wrongs[] = {
      {"version", [](Json& j) { j["version"] = "2.0.0"; }, "version: \"2.0.0\" was found, and 1.0.0"},
      {"type", [](Json& j) { j["dataType"] = "zip"; }, "dataType: \"zip\" was found, and laszip"},
      {"hierarchy", [](Json& j) { j["hierarchyType"] = "gzip"; }, "hierarchyType: \"gzip\" was found"},
      {"no points", [](Json& j) { j.erase("points"); }, "there is no \"points\""},
      {"cube", [](Json& j) { j["bounds"][3] = 2000; }, "bounds: 1900 x 1024 x 1024 was found, and a cube"},
      {"upside down", [](Json& j) { j["bounds"][3] = 0; }, "bounds: minima of x, y and z"},
      {"no Y", [](Json& j) { j["schema"][1]["name"] = "W"; }, "schema: there is no dimension Y"},
      {"size", [](Json& j) { j["schema"][3]["size"] = 3; }, "schema[3].type: \"unsigned\" of 3 bytes"},
      {"scale", [](Json& j) { j["schema"][0]["scale"] = 0; }, "schema[0].scale: a number above 0"},
  };
  for (const Wrong& wrong : wrongs) {
    const ScratchFolder folder;
    const EptFiles files;
    Json metadata = files.metadata();
    wrong.change(metadata);
    files.write(folder);
    write_bytes(folder.path("ept.json"), TreeFiles::bytes_of(metadata));
    EXPECT_TRUE(contains(error_of([&] { open_tree(folder.path("")); }), wrong.message)) << wrong.what;
  }
}

TEST(EptStore, WhatIsWrongInAPageIsNamed) {
  const Wrong wrongs[] = {
      {"key", [](Json& j) { j["1-0-0"] = 5; }, "\"1-0-0\" is no node of this page"},
      {"text", [](Json& j) { j["1-0-0-x"] = 5; }, "is no node of this page"},
      {"outside", [](Json& j) { j["1-0-0-2"] = 5; }, "is no node of this page"},
      {"deep", [](Json& j) { j["32-0-0-0"] = 5; }, "is no node of this page"},
      {"list",
       [](Json& j) {
         j["0-0-0-0"] = {1, 2};
       },
       "0-0-0-0: a list was found, and a whole number"},
      {"many", [](Json& j) { j["0-0-0-0"] = 1ull << 60; }, "0-0-0-0: 1152921504606846976 was found"},
      {"no object", [](Json& j) { j = 5; }, "the page: 5 was found, and an object was expected"},
      {"count", [](Json& j) { j["0-0-0-0"] = -2; }, "0-0-0-0: -2 was found, and a whole number"},
      {"itself", [](Json& j) { j["0-0-0-0"] = -1; }, "0-0-0-0: the page refers to itself"},
  };
  for (const Wrong& wrong : wrongs) {
    const ScratchFolder folder;
    const EptFiles files;
    Json page = files.pages().at("0-0-0-0");
    wrong.change(page);
    files.write(folder);
    write_bytes(folder.path("ept-hierarchy/0-0-0-0.json"), TreeFiles::bytes_of(page));
    EXPECT_TRUE(contains(error_of([&] { open_tree(folder.path("")); }), wrong.message)) << wrong.what;
  }
}

TEST(EptStore, APageOfManyNodesIsReadInNoTime) {
  std::string text = "{\"0-0-0-0\": 1";
  for (int x = 0; x < 300; ++x)
    for (int y = 0; y < 300; ++y) text += ", \"9-" + std::to_string(x) + "-" + std::to_string(y) + "-0\": 7";
  const auto start = std::chrono::steady_clock::now();
  const auto piece = ept::parse_page(text + "}", StoredNode{}, "page");
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(20));
  EXPECT_GT(piece.nodes.size(), 90'000u);
}

TEST(EptStore, APageHasToBeginWithItsNode) {
  const ScratchFolder folder;
  EptFiles files;
  files.write(folder);
  Json page = files.pages().at("1-0-0-0");
  page.erase("1-0-0-0");
  write_bytes(folder.path("ept-hierarchy/1-0-0-0.json"), TreeFiles::bytes_of(page));
  EXPECT_TRUE(contains(error_of([&] { open_source(folder.path("")); }), "the page is named after"));
  std::filesystem::remove(folder.path("ept-hierarchy/1-0-0-0.json"));
  EXPECT_TRUE(contains(error_of([&] { open_source(folder.path("")); }), "1-0-0-0.json: there is no such file"));
}

TEST(EptStore, AZstandardNodeThatIsNoneIsNamed) {
  const ScratchFolder folder;
  EptFiles files;
  files.data_type = "zstandard";
  files.write(folder);
  Bytes bytes = files.node_bytes("r");
  bytes.resize(bytes.size() / 2);
  write_bytes(folder.path("ept-data/0-0-0-0.zst"), bytes);
  const auto source = open_source(folder.path(""));
  const std::string message = error_of([&] { source->read({}, [](const PointBatch&) {}); });
  EXPECT_TRUE(contains(message, "ept-data/0-0-0-0.zst: the 60 points of node 0-0-0-0 were expected in"));
  EXPECT_TRUE(contains(message, "no Zstandard stream that unpacks to 1260 bytes"));
}

}  // namespace
}  // namespace stipple::test::octree_ept_store
