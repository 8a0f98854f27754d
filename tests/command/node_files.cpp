// `stipple info` and `stipple render` of trees with a file for every node.
#include "tests/octree/node_files.h"

#include <gtest/gtest.h>

#include "tests/command/run_stipple.h"

namespace stipple::test::command_node_files {
namespace {

Json info_of(const ScratchFolder& folder, const std::string& arguments) {
  const Outcome outcome = run_stipple(folder, "info --json " + arguments);
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  return Json::parse(outcome.out);
}

TEST(NodeFilesCommands, InfoSaysWhereTheNumberOfPointsComesFrom) {
  const ScratchFolder folder, tree;
  const EptFiles files;
  files.write(tree);
  Json metadata = files.metadata();
  metadata["points"] = 400;
  write_bytes(tree.path("ept.json"), TreeFiles::bytes_of(metadata));
  const Json stated = info_of(folder, tree.path(""));
  EXPECT_EQ(stated.at("format"), "EPT");
  EXPECT_EQ(stated.at("version"), "1.1.0");
  EXPECT_EQ(stated.at("encoding"), "binary, 21 bytes a point");
  EXPECT_EQ(stated.at("points"), 400);
  EXPECT_EQ(stated.at("points_from"), "metadata");
  EXPECT_TRUE(stated.at("file_bytes").is_null());
  const Json exact = info_of(folder, "--exact " + tree.path("ept.json"));
  EXPECT_EQ(exact.at("points"), 360);
  EXPECT_EQ(exact.at("points_from"), "nodes");
  EXPECT_EQ(exact.at("file_bytes"), 360 * 21);
  EXPECT_TRUE(contains(run_stipple(folder, "info --exact " + tree.path("")).err,
                       "the metadata state 400 points, and the nodes hold 360"));
}

TEST(NodeFilesCommands, InfoCountsNodesWhereMetadataDoNot) {
  const ScratchFolder folder, tree;
  Potree1Files files;
  files.lie = 5;
  const Json info = info_of(folder, files.write(tree));
  EXPECT_EQ(info.at("format"), "Potree");
  EXPECT_EQ(info.at("version"), "1.7");
  EXPECT_EQ(info.at("points"), 360);
  EXPECT_EQ(info.at("points_from"), "nodes");
  // What levels hold is what the hierarchy says, unless --exact asks the nodes
  EXPECT_EQ(info.at("octree").at("levels").at(0).at("points"), 65);
  const Json exact = info_of(folder, "--exact " + tree.path("cloud.js"));
  EXPECT_EQ(exact.at("octree").at("levels").at(0).at("points"), 60);
}

TEST(NodeFilesCommands, InfoExactOfATreeThatLacksANodeIsExitCodeOne) {
  const ScratchFolder folder, tree;
  EptFiles().write(tree);
  std::filesystem::remove(tree.path(EptFiles::node_file("r3", "binary")));
  EXPECT_EQ(run_stipple(folder, "info " + tree.path("")).code, 0);
  const Outcome outcome = run_stipple(folder, "info --exact " + tree.path(""));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.err, "1-0-1-1.bin: there is no such file, and the 60 points of node 1-0-1-1"));
}

TEST(NodeFilesCommands, BuildTakesThem) {
  const ScratchFolder folder, ept, potree;
  for (const std::string& tree : {EptFiles().write(ept), Potree1Files().write(potree)}) {
    const std::string built = folder.path("built-" + std::to_string(tree == ept.path("")));
    const Outcome build = run_stipple(folder, "build " + tree + " -o " + built);
    ASSERT_EQ(build.code, 0) << build.err;
    const Outcome check = run_stipple(folder, "check " + built + " --against " + tree);
    EXPECT_EQ(check.code, 0) << check.err;
    EXPECT_TRUE(contains(check.out, "the same 360 points as the inputs; largest rounding 0"));
  }
}

TEST(NodeFilesCommands, RenderDrawsThemFromDisk) {
  const ScratchFolder folder, ept, potree;
  for (const std::string& tree : {EptFiles().write(ept), Potree1Files().write(potree)}) {
    const Outcome outcome =
        run_stipple(folder, "render " + tree + " -o " + folder.path("tree.png") +
                                " --mode hierarchical --size 64x64 --stats " + folder.path("stats.json"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    const Json stats = json_file(folder.path("stats.json"));
    EXPECT_EQ(stats.at("converged"), true);
    EXPECT_EQ(stats.at("points_total"), 360);
    EXPECT_EQ(stats.at("points_drawn"), 360);
    EXPECT_EQ(stats.at("nodes_visible"), 6);
    EXPECT_GT(stats.at("bytes_read"), 360 * 19);
  }
}

TEST(NodeFilesCommands, RenderOfATreeThatLacksANodeDrawsTheRestAndIsExitCodeOne) {
  for (const char* mode : {"hybrid", "hierarchical", "lod"}) {
    const ScratchFolder folder, tree;
    EptFiles().write(tree);
    std::filesystem::remove(tree.path(EptFiles::node_file("r04", "binary")));
    const Outcome outcome = run_stipple(folder, "render " + tree.path("") + " -o " + folder.path("tree.png") +
                                                    " --stats " + folder.path("stats.json") + " --mode " + mode);
    EXPECT_EQ(outcome.code, 1);
    EXPECT_TRUE(contains(outcome.err, "a part of the octree could not be read")) << outcome.err;
    EXPECT_TRUE(contains(outcome.err, "2-1-0-0.bin: there is no such file")) << outcome.err;
    EXPECT_TRUE(std::filesystem::exists(folder.path("tree.png")));
    const Json stats = json_file(folder.path("stats.json"));
    EXPECT_EQ(stats.at("parts_unread"), 1);
    EXPECT_EQ(stats.at("converged"), false);
  }
}

}  // namespace
}  // namespace stipple::test::command_node_files
