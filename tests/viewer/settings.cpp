#include "src/viewer/settings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "octree/core/error.h"
#include "tests/octree/las_fixture.h"

namespace stipple::test::viewer_settings {
namespace {

TEST(ViewerSettings, ComeBackAsTheyWereWritten) {
  const ScratchFolder folder;
  const std::string path = folder.path("not/there/yet/viewer.json");
  const ViewerSettings settings{.background = 0x102030,
                                .point_size = 3,
                                .frames_per_second = 24,
                                .shaded = true,
                                .eye_dome = {.strength = 1.5, .radius = 3},
                                .panel_shown = false};
  write_settings(path, settings);
  EXPECT_EQ(read_settings(path), settings);
}

TEST(ViewerSettings, ADamagedFileGivesTheDefaults) {
  const ScratchFolder folder;
  EXPECT_EQ(read_settings(folder.path("missing.json")), ViewerSettings{});
  for (const char* text :
       {"", "{", "[1, 2]", "7", R"({"point_size": "large", "background": null, "panel_shown": 3})"}) {
    std::ofstream(folder.path("viewer.json")) << text;
    EXPECT_EQ(read_settings(folder.path("viewer.json")), ViewerSettings{}) << text;
  }
  std::ofstream(folder.path("viewer.json")) << R"({"point_size": 1e300, "frames_per_second": -5})";
  EXPECT_EQ(read_settings(folder.path("viewer.json")).point_size, 10.0);
  EXPECT_EQ(read_settings(folder.path("viewer.json")).frames_per_second, 5.0);
}

TEST(ViewerSettings, AreInTheFoldersThatXdgNames) {
  const std::string home = std::getenv("HOME") ? std::getenv("HOME") : "";
  ::setenv("HOME", "/home/someone", 1);
  ::setenv("XDG_CONFIG_HOME", "/config", 1);
  ::unsetenv("XDG_STATE_HOME");
  EXPECT_EQ(settings_path(), "/config/stipple/viewer.json");
  EXPECT_EQ(recent_path(), "/home/someone/.local/state/stipple/recent.json");
  ::setenv("XDG_CONFIG_HOME", "relative", 1);
  EXPECT_EQ(settings_path(), "/home/someone/.config/stipple/viewer.json");
  ::unsetenv("XDG_CONFIG_HOME");
  ::unsetenv("HOME");
  EXPECT_EQ(settings_path(), "");
  write_settings(settings_path(), {});
  ::setenv("HOME", home.c_str(), 1);
}

TEST(RecentInputs, TheLatestIsFirstAndStandsThereOnce) {
  RecentInputs recent;
  remember(recent, {"/a.las"});
  remember(recent, {"/b.las", "/c.las"});
  remember(recent, {"/x/../a.las"});
  EXPECT_EQ(recent, (RecentInputs{{"/a.las"}, {"/b.las", "/c.las"}}));
  for (int i = 0; i < 20; ++i) remember(recent, {fmt::format("/{}", i)});
  EXPECT_EQ(recent.size(), 10u);
  EXPECT_EQ(recent.front().front(), "/19");
}

TEST(RecentInputs, ComeBackAsTheyWereWritten) {
  const ScratchFolder folder;
  const RecentInputs recent{{"/a b.las"}, {"/c.las", "/d"}};
  write_recent(folder.path("recent.json"), recent);
  EXPECT_EQ(read_recent(folder.path("recent.json")), recent);
  std::ofstream(folder.path("recent.json")) << R"([["/a"], [], [1], "x", ["/b", 2]])";
  EXPECT_EQ(read_recent(folder.path("recent.json")), (RecentInputs{{"/a"}}));
}

}  // namespace
}  // namespace stipple::test::viewer_settings
