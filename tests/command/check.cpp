// `stipple check`, and `stipple info` and `stipple render` of a tree.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/command/run_stipple.h"
#include "tests/octree/potree2_files.h"
#include "tests/octree/stream_build_fixture.h"

namespace stipple::test::command_check {
namespace {

TEST(CheckCommand, AWholeTreeIsATableAndExitCodeZero) {
  const ScratchFolder folder, other;
  const std::string tree = TreeFiles::usual().write(folder);
  const std::string same = TreeFiles::usual("BROTLI").write(other);
  const Outcome text = run_stipple(folder, "check " + tree + " --against " + same);
  EXPECT_EQ(text.code, 0) << text.err;
  EXPECT_TRUE(contains(text.out, "360 points in 6 nodes, 7,560 bytes"));
  EXPECT_TRUE(contains(text.out, "the same 360 points as the inputs"));
  const Outcome json = run_stipple(folder, "check " + tree + " --json --against " + same);
  ASSERT_EQ(json.code, 0) << json.err;
  const Json document = Json::parse(json.out);
  EXPECT_EQ(document.at("ok"), true);
  EXPECT_EQ(document.at("levels").size(), 3u);
  EXPECT_EQ(document.at("against").at("points"), 360);
}

TEST(CheckCommand, ADefectIsNamedWithItsNodeAndExitCodeOne) {
  const ScratchFolder folder;
  TreeFiles files = TreeFiles::usual();
  files.nodes["r70"][3].position = glm::ivec3(0);
  const std::string tree = files.write(folder);
  const Outcome text = run_stipple(folder, "check " + tree);
  EXPECT_EQ(text.code, 1);
  EXPECT_TRUE(contains(text.err, "stipple: " + tree + ": node r70: its point 3"));
  const Outcome json = run_stipple(folder, "check --json " + tree);
  EXPECT_EQ(json.code, 1);
  EXPECT_EQ(Json::parse(json.out).at("defect").at("node"), "r70");
}

TEST(CheckCommand, ADifferenceFromTheInputIsExitCodeOne) {
  const ScratchFolder folder, other;
  const std::string tree = TreeFiles::usual().write(folder);
  TreeFiles files = TreeFiles::usual();
  files.nodes["r3"][0].intensity = 9;
  const Outcome outcome = run_stipple(folder, "check " + tree + " --against " + files.write(other));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.err, "times in the inputs"));
}

// From the command line alone, with every attribute: all scenes, and clouds that are hard to divide.
class BuildAndCheck : public testing::TestWithParam<std::string> {
 protected:
  void build_and_check(const ScratchFolder& folder, const std::string& las) const {
    for (const char* options : {"", " --sampling random", " --encoding BROTLI"}) {
      const std::string tree = folder.path("tree");
      const Outcome built = run_stipple(folder, "build " + las + " -o " + tree + " --force" + options);
      ASSERT_EQ(built.code, 0) << options << built.err;
      const Outcome checked = run_stipple(folder, "check " + tree + " --against " + las);
      EXPECT_EQ(checked.code, 0) << options << checked.err;
    }
  }
};

TEST_P(BuildAndCheck, ASceneIsInItsTreePointByPoint) {
  const ScratchFolder folder;
  const std::string las = folder.path("scene.las");
  write_las(*make_scene(GetParam(), 60'000, 1), las);
  build_and_check(folder, las);
}

INSTANTIATE_TEST_SUITE_P(Scenes, BuildAndCheck, testing::ValuesIn(scene_names()),
                         [](const auto& test) { return test.param; });

class BuildAndCheckCloud : public BuildAndCheck {};

TEST_P(BuildAndCheckCloud, IsInItsTreePointByPoint) {
  const auto clouds = test_clouds();
  const auto cloud = std::ranges::find(clouds, GetParam(), &TestCloud::name);
  const ScratchFolder folder;
  write_las(CloudSource(*cloud), folder.path("cloud.las"));
  build_and_check(folder, folder.path("cloud.las"));
}

std::vector<std::string> cloud_names() {
  std::vector<std::string> names;
  for (const TestCloud& cloud : test_clouds()) names.push_back(cloud.name);
  return names;
}

INSTANTIATE_TEST_SUITE_P(Clouds, BuildAndCheckCloud, testing::ValuesIn(cloud_names()),
                         [](const auto& test) { return test.param; });

TEST(CheckCommand, WhatIsNoTreeIsExitCodeOne) {
  const ScratchFolder folder;
  const Outcome outcome = run_stipple(folder, "check " + folder.path(""));
  EXPECT_EQ(outcome.code, 1);
  EXPECT_TRUE(contains(outcome.err, "is no octree that is read"));
}

TEST(TreeCommands, InfoSaysTheLevels) {
  const ScratchFolder folder;
  const std::string tree = TreeFiles::usual("BROTLI").write(folder);
  EXPECT_TRUE(
      contains(run_stipple(folder, "info " + tree).out, "level 1               3 nodes              180 points"));
  const Outcome json = run_stipple(folder, "info --json " + tree + "metadata.json");
  ASSERT_EQ(json.code, 0) << json.err;
  const Json document = Json::parse(json.out);
  EXPECT_EQ(document.at("points"), 360);
  EXPECT_EQ(document.at("octree").at("nodes"), 6);
  EXPECT_EQ(document.at("octree").at("depth"), 2);
  EXPECT_EQ(document.at("octree").at("levels").at(2).at("points"), 120);
  EXPECT_EQ(document.at("octree").at("spacing"), 8.0);
}

TEST(TreeCommands, RenderTakesATree) {
  const ScratchFolder folder;
  const std::string tree = TreeFiles::usual().write(folder);
  const Outcome outcome =
      run_stipple(folder, "render " + tree + " -o " + folder.path("tree.png") + " --mode reference --size 64x64");
  EXPECT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(std::filesystem::exists(folder.path("tree.png")));
}

}  // namespace
}  // namespace stipple::test::command_check
