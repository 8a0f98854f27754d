#include "octree/store/potree1/potree1_store.h"

#include <gtest/gtest.h>

#include "octree/store/tree_source.h"
#include "src/check/check_tree.h"
#include "tests/octree/node_files.h"

namespace stipple::test::octree_potree1_store {
namespace {

using test::Bytes;
using test::contains;
using test::error_of;
using test::points_in_steps;
using test::Potree1Files;
using test::put;
using test::ScratchFolder;
using test::sorted;
using test::TreeFiles;
using test::write_bytes;

const std::vector<std::string> kAttributes{"classification", "rgb", "intensity"};

class Potree1Version : public testing::TestWithParam<const char*> {
 protected:
  Potree1Version() { files_.version = GetParam(); }
  Potree1Files files_;
  ScratchFolder folder_;
};

TEST_P(Potree1Version, EveryPointIsReadAsItWasWritten) {
  const Cloud cloud = load_cloud(*open_source(files_.write(folder_)), kAttributes);
  EXPECT_EQ(sorted(points_in_steps(cloud)), sorted(files_.points()));
  // 1024 units of 2048 steps divide evenly: no finer grid is needed where all levels are known
  if (files_.is_flat()) {
    EXPECT_EQ(cloud.info.grid.scale, glm::dvec3(0.5));
  }
}

TEST_P(Potree1Version, TheTreeIsWhole) {
  const auto store = open_tree(files_.write(folder_));
  const TreeReport report = check_tree(*store);
  EXPECT_FALSE(report.defect) << report.defect->node << ": " << report.defect->what;
  EXPECT_EQ(report.nodes, 6u);
  EXPECT_EQ(report.points, 360u);
  EXPECT_EQ(store->info().source.point_count, 360u);
  EXPECT_EQ(store->info().states_points, files_.version == "1.8");
  EXPECT_EQ(store->info().source.format, "Potree");
  EXPECT_EQ(store->info().source.version, GetParam());
}

TEST_P(Potree1Version, PartsAreSlicesOfTheWhole) {
  const auto store = open_tree(files_.write(folder_));
  const StoredNode root = store->locate(store->root_piece().nodes[0]);
  PointBatch whole, part;
  store->read_points(root, {}, whole);
  store->read_part(root, 7, 20, {}, part);
  ASSERT_EQ(part.positions.size(), 20u);
  EXPECT_TRUE(std::equal(part.positions.begin(), part.positions.end(), whole.positions.begin() + 7));
}

TEST_P(Potree1Version, AMissingNodeIsNamed) {
  files_.write(folder_);
  std::filesystem::remove(folder_.path(files_.file_of("r04", ".bin")));
  const std::string message = error_of([&] { open_source(folder_.path("")); });
  EXPECT_TRUE(contains(message, files_.file_of("r04", ".bin") + ": there is no such file, and the points of node r04"));
}

TEST_P(Potree1Version, ANodeCutOffIsNamed) {
  files_.write(folder_);
  Bytes bytes = files_.rows("r3");
  bytes.resize(bytes.size() - 5);
  write_bytes(folder_.path(files_.file_of("r3", ".bin")), bytes);
  const std::string message = error_of([&] { open_source(folder_.path("")); });
  EXPECT_TRUE(contains(message, files_.file_of("r3", ".bin") + ": at byte " + std::to_string(bytes.size())));
  EXPECT_TRUE(contains(message, files_.version == "1.8" ? "multiple of 27 bytes" : "multiple of 19 bytes"));
}

INSTANTIATE_TEST_SUITE_P(All, Potree1Version, testing::Values("1.4", "1.7", "1.8"),
                         [](const auto& param) { return std::string("v1_") + param.param[2]; });

TEST(Potree1Store, CountsComeFromTheFilesNotFromTheHierarchy) {
  const ScratchFolder folder;
  Potree1Files files;
  files.lie = 13;
  const auto store = open_tree(files.write(folder));
  EXPECT_EQ(store->info().source.point_count, 360u);
  EXPECT_EQ(store->root_piece().nodes[0].points, 73u);
  EXPECT_EQ(store->locate(store->root_piece().nodes[0]).points, 60u);
}

TEST(Potree1Store, OpeningReadsTheFirstPieceAloneIfTheMetadataStateTheirPoints) {
  const ScratchFolder folder;
  Potree1Files files;
  files.version = "1.8";
  files.write(folder);
  std::filesystem::remove_all(folder.path("data/r/0"));
  std::filesystem::remove(folder.path("data/r/r.bin"));
  const auto store = open_tree(folder.path("cloud.js"));
  EXPECT_EQ(store->root_piece().nodes.size(), 4u);
  EXPECT_EQ(store->root_piece().continued.size(), 2u);
  EXPECT_TRUE(contains(error_of([&] { read_whole_hierarchy(*store); }), "data/r/0/r0.hrc: there is no such file"));
}

TEST(Potree1Store, StepsOfSeveralLevelsNameTheFolders) {
  const ScratchFolder folder;
  Potree1Files files;
  files.step_size = 2;
  files.tree.nodes["r700"] = TreeFiles::points_in("r700");
  files.write(folder);
  EXPECT_TRUE(std::filesystem::exists(folder.path("data/r/70/r700.bin")));
  EXPECT_TRUE(std::filesystem::exists(folder.path("data/r/70/r70.hrc")));
  const Cloud cloud = load_cloud(*open_source(folder.path("")), kAttributes);
  EXPECT_EQ(sorted(points_in_steps(cloud)), sorted(files.points()));
}

TEST(Potree1Store, TimesComeAsTheyAre) {
  const ScratchFolder folder;
  Potree1Files files;
  files.version = "1.8";
  const Cloud cloud = load_cloud(*open_source(files.write(folder)), {"gps-time", "intensity"});
  for (std::size_t i = 0; i < cloud.size(); ++i)
    EXPECT_EQ(value_at(*cloud.find("gps-time"), i), 0.25 * value_at(*cloud.find("intensity"), i));
}

TEST(Potree1Store, AttributesWithoutATypeAreKnownByName) {
  const ScratchFolder folder;
  Potree1Files files;
  files.version = "1.8";
  files.write(folder);
  Json metadata = files.metadata();
  for (Json& attribute : metadata["pointAttributes"]) attribute.erase("type");
  metadata["pointAttributes"][4]["name"] = "odd";
  write_bytes(folder.path("cloud.js"), TreeFiles::bytes_of(metadata));
  const Cloud cloud = load_cloud(*open_source(folder.path("")), kAttributes);
  EXPECT_EQ(sorted(points_in_steps(cloud)), sorted(files.points()));
  const Schema schema = open_tree(folder.path(""))->info().source.schema;
  EXPECT_EQ(schema.at(*find_attribute(schema, "odd")).components, 8);
}

TEST(Potree1Store, CornersOffTheGridMakeItFiner) {
  const WorldBox cube{{0, 0, 0}, {1738.6, 1738.6, 1738.6}};
  // 1,738,600 steps are 8 times an odd number
  EXPECT_EQ(potree1::grid_of(cube, 0.001, 3).scale.x, 0.001);
  EXPECT_EQ(potree1::grid_of(cube, 0.001, 5).scale.x, 0.00025);
  // As fine as 32 bits allow, and never finer than 2^-10
  EXPECT_EQ(potree1::grid_of(cube, 0.001, 20).scale.x, 0.001 / 256);
  EXPECT_EQ(potree1::grid_of({{0, 0, 0}, {4.64789, 4.64789, 4.64789}}, 0.001, 3).scale.x, 0.001 / 1024);
}

struct Wrong {
  const char* what;
  std::function<void(Json&)> change;
  const char* message;
};

TEST(Potree1Store, WhatIsWrongInTheMetadataIsNamed) {
  const Wrong wrongs[] = {
      {"version", [](Json& j) { j["version"] = "1.3"; }, "version: \"1.3\" was found, and 1.4 to 1.8"},
      {"no number", [](Json& j) { j["version"] = "1.x"; }, "version: \"1.x\" was found"},
      {"cube", [](Json& j) { j["boundingBox"]["ux"] = 2000; }, "boundingBox: 1900 x 1024 x 1024 was found"},
      {"scale", [](Json& j) { j["scale"] = 0; }, "scale: a number above 0"},
      {"attribute", [](Json& j) { j["pointAttributes"][2] = "SMELL"; },
       "pointAttributes[2]: \"SMELL\" is no attribute"},
      {"format", [](Json& j) { j["pointAttributes"] = "PLY"; }, "pointAttributes: \"PLY\" was found, and LAS, LAZ"},
      {"position", [](Json& j) { j["pointAttributes"].erase(0); }, "POSITION_CARTESIAN was expected"},
      {"twice", [](Json& j) { j["pointAttributes"][3] = "INTENSITY"; }, "\"intensity\" was there already"},
      {"step", [](Json& j) { j.erase("hierarchyStepSize"); }, "there is no \"hierarchy\""},
      {"list",
       [](Json& j) {
         j.erase("hierarchyStepSize");
         j["hierarchy"] = Json::parse(R"([["r", 5], ["q1", 6]])");
       },
       "\"q1\" was found, and r with digits 0 to 7"},
      {"digit",
       [](Json& j) {
         j.erase("hierarchyStepSize");
         j["hierarchy"] = Json::parse(R"([["r", 5], ["r8", 6]])");
       },
       "\"r8\" was found"},
  };
  for (const Wrong& wrong : wrongs) {
    const ScratchFolder folder;
    const Potree1Files files;
    Json metadata = files.metadata();
    wrong.change(metadata);
    files.write(folder);
    write_bytes(folder.path("cloud.js"), TreeFiles::bytes_of(metadata));
    EXPECT_TRUE(contains(error_of([&] { open_tree(folder.path("")); }), wrong.message)) << wrong.what;
  }
}

TEST(Potree1Store, WhatIsWrongInAPieceIsNamed) {
  const ScratchFolder folder;
  const Potree1Files files;
  files.write(folder);
  const auto message_of = [&](const Bytes& bytes) {
    write_bytes(folder.path("data/r/r.hrc"), bytes);
    return error_of([&] { open_tree(folder.path("")); });
  };
  Bytes bytes = files.piece("r");
  EXPECT_TRUE(contains(message_of({}), "r.hrc: at byte 0: the file ends here"));
  EXPECT_TRUE(contains(message_of({bytes.begin(), bytes.begin() + 7}), "r.hrc: at byte 7: the file ends here"));
  EXPECT_TRUE(contains(message_of({bytes.begin(), bytes.begin() + 15}),
                       "r.hrc: at byte 15: the hierarchy piece ends here, and child 7 of node r"));
  bytes.resize(bytes.size() + 5);
  EXPECT_TRUE(contains(message_of(bytes), "has 5 nodes, and 4 by their child masks were expected"));
}

}  // namespace
}  // namespace stipple::test::octree_potree1_store
