// The viewer as it is used: opened, moved, picked from, given files and trees.
#include "src/viewer/viewer.h"

#include <fmt/format.h>

#include <filesystem>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "src/camera/camera_file.h"
#include "src/run/median.h"
#include "tests/octree/node_files.h"
#include "tests/window/viewer_window.h"

namespace stipple::test::window_viewer {
namespace {

TEST_F(ViewerWindow, OpensOrbitsTakesEveryMethodAndShowsWhatRenderDraws) {
  start(2.0);
  ASSERT_TRUE(complete());
  const Camera begin = viewer_->rig().camera();
  display().button(1, true);
  for (int i = 1; i <= 10; ++i) {
    display().move(kCentreX + 5 * i, kCentreY + 3 * i);
    steps(2);
    EXPECT_TRUE(covered()) << "no frame is blank";
  }
  display().button(1, false);
  EXPECT_NE(viewer_->rig().camera().eye, begin.eye);
  EXPECT_NEAR(glm::distance(viewer_->rig().camera().eye, viewer_->rig().pivot()),
              glm::distance(begin.eye, viewer_->rig().pivot()), 1e-6);

  std::optional<Image> last;
  for (const auto& [key, mode] : {std::pair{"F1", Mode::unstructured}, std::pair{"F2", Mode::hierarchical},
                                  std::pair{"F4", Mode::brute_force}, std::pair{"F3", Mode::hybrid}}) {
    display().press(key);
    ASSERT_TRUE(until([&, wanted = mode] {
      EXPECT_TRUE(covered()) << "no frame is blank";
      return viewer_->stage().pane().mode() == wanted && viewer_->at_rest();
    })) << key;
    const Image now = viewer_->picture();
    if (last) {
      EXPECT_EQ(now.rgb, last->rgb) << key;
    }
    last = now;
  }
  EXPECT_EQ(last->rgb, headless().rgb);
}

// Lod stops at its budget, which holds all of these points; subsample goes on until all are there.
TEST_F(ViewerWindow, TakesTheMethodsOfEarlierViewersAndGoesBack) {
  start(2.0);
  ASSERT_TRUE(complete());
  const Image hybrid = viewer_->picture();
  for (const auto& [key, mode] : {std::pair{"F5", Mode::lod}, {"F6", Mode::subsample}, {"F3", Mode::hybrid}}) {
    display().press(key);
    ASSERT_TRUE(until([&, wanted = mode] {
      EXPECT_TRUE(covered()) << "no frame is blank";
      return viewer_->stage().pane().mode() == wanted && viewer_->at_rest();
    })) << key;
    // lod ends at its budget, which the time that frames take decides
    if (mode != Mode::lod) {
      EXPECT_EQ(viewer_->picture().rgb, hybrid.rgb) << key;
    }
  }
}

TEST_F(ViewerWindow, AStillViewDrawsNothing) {
  start();
  ASSERT_TRUE(complete());
  const std::uint64_t drawn = viewer_->stage().frames();
  const std::uint64_t shown = viewer_->frames_shown();
  steps(20);
  EXPECT_EQ(viewer_->stage().frames(), drawn);
  EXPECT_EQ(viewer_->frames_shown(), shown);
}

TEST_F(ViewerWindow, PicksPointsAsTheFileHasThem) {
  start(4.0);
  ASSERT_TRUE(complete());
  // With an octree in memory it knows the point's node
  display().press("F2");
  ASSERT_TRUE(complete());
  const auto pick_at = [&](int x, int y, std::size_t count) {
    display().move(x, y);
    steps(3);
    display().click(1);
    return until([&] { return viewer_->picks().size() == count && !viewer_->picks().back().values.empty(); });
  };
  ASSERT_TRUE(pick_at(kCentreX, kCentreY, 1));
  ASSERT_TRUE(pick_at(kCentreX - 60, kCentreY - 10, 2));

  const Cloud cloud = load_cloud(*open_source(city_), {"intensity", "rgb"});
  for (const Pick& pick : viewer_->picks()) {
    const glm::ivec3 p = cloud.positions[pick.pixel.id];
    EXPECT_EQ(p, pick.pixel.position);
    for (int axis = 0; axis < 3; ++axis) {
      const double written = std::stod(pick.place[static_cast<std::size_t>(axis)]);
      EXPECT_EQ(std::llround((written - cloud.info.grid.offset[axis]) / cloud.info.grid.scale[axis]), p[axis]);
    }
    const Column& intensity = *cloud.find("intensity");
    const auto value = std::ranges::find(pick.values, "intensity", &std::pair<std::string, std::string>::first);
    ASSERT_NE(value, pick.values.end());
    EXPECT_EQ(std::stod(value->second), value_at(intensity, pick.pixel.id));
    EXPECT_EQ(pick.values[0].first, "node");
    EXPECT_TRUE(pick.values[0].second.starts_with("r")) << pick.values[0].second;
  }
}

TEST_F(ViewerWindow, ZoomsTurnsFliesAndGoesHome) {
  start(3.0);
  ASSERT_TRUE(complete());
  const Camera home = viewer_->rig().camera();
  const auto moves = [&](const char* what, const std::function<void()>& act) {
    const Camera before = viewer_->rig().camera();
    act();
    EXPECT_TRUE(until([&] { return viewer_->rig().camera().eye != before.eye; })) << what;
  };
  moves("wheel", [&] { display().click(4); });
  moves("fly", [&] {
    display().key("w", true);
    steps(10);
    display().key("w", false);
  });
  for (const char* side : {"1", "2", "3", "4", "5", "6"}) moves(side, [&] { display().press(side); });
  display().press("h");
  EXPECT_TRUE(until([&] { return viewer_->rig().camera().eye == home.eye; }));
  EXPECT_TRUE(complete());
  EXPECT_EQ(viewer_->picture().rgb, headless().rgb);
}

TEST_F(ViewerWindow, RecordsAPathAndFliesItAgain) {
  const auto before = std::filesystem::current_path();
  std::filesystem::current_path(folder_.path("."));
  start(3.0);
  ASSERT_TRUE(complete());
  display().press("r");
  steps(3);
  display().button(1, true);
  for (int i = 1; i <= 60; ++i) {
    display().move(kCentreX + 2 * i, kCentreY);
    viewer_->step(0.01);
  }
  display().button(1, false);
  steps(3);
  const Camera end = viewer_->rig().camera();
  display().press("r");
  ASSERT_TRUE(until([] { return std::filesystem::exists("path.json"); }));
  const CameraPath path = read_paths("path.json").front();
  std::filesystem::current_path(before);
  EXPECT_GT(path.keys.size(), 2u);
  display().press("h");
  ASSERT_TRUE(complete());
  display().press("t");
  // The last key is at most an interval before the end
  ASSERT_TRUE(until([&] { return viewer_->rig().camera().eye == path.keys.back().camera.eye; }));
  EXPECT_LT(glm::distance(viewer_->rig().camera().eye, end.eye), glm::distance(end.eye, path.keys.front().camera.eye));
}

TEST_F(ViewerWindow, ADoubleClickSetsThePivot) {
  start(4.0);
  ASSERT_TRUE(complete());
  const glm::dvec3 before = viewer_->rig().pivot();
  display().click(1);
  display().click(1);
  EXPECT_TRUE(until([&] { return viewer_->rig().pivot() != before; }));
}

TEST_F(ViewerWindow, GoesOnAtAnySize) {
  start();
  ASSERT_TRUE(complete());
  for (const glm::ivec2 size : {glm::ivec2(1, 1), glm::ivec2(3, 200), glm::ivec2(500, 300)}) {
    display().resize_window(size.x, size.y);
    ASSERT_TRUE(until([&] { return window_->size() == size; }));
    ASSERT_TRUE(complete()) << size.x;
    EXPECT_EQ(viewer_->picture().size, size);
  }
  EXPECT_EQ(viewer_->picture().rgb, headless().rgb);
}

TEST_F(ViewerWindow, AFileThatVanishesOrIsNoneIsASentence) {
  start();
  ASSERT_TRUE(complete());
  std::filesystem::remove(city_);
  display().press("c");
  ASSERT_TRUE(until([&] { return !viewer_->stage().error().empty(); }));
  EXPECT_NE(viewer_->stage().error().find("city.las"), std::string::npos);
  EXPECT_TRUE(covered());
  viewer_->open({folder_.path("nothing.las")});
  ASSERT_TRUE(until([&] { return viewer_->stage().error().find("nothing.las") != std::string::npos; }));
  const std::string other = city_file(folder_, 1'000, "other.las");
  viewer_->open({other});
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->stage().dataset()->info.point_count, 1'000u);
  EXPECT_EQ(viewer_->stage().error(), "");
}

TEST_F(ViewerWindow, AnOctreeOnDiskIsDrawnFromThere) {
  const std::string tree = folder_.path("tree");
  ASSERT_EQ(run_stipple(folder_, "build " + city_ + " -o " + tree).code, 0);
  start(1.0, tree);
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->stage().pane().mode(), Mode::hybrid);
  EXPECT_FALSE(viewer_->stage().dataset()->in_memory());
  const Image from_disk = viewer_->picture();
  display().click(1);
  ASSERT_TRUE(until([&] { return !viewer_->picks().empty() && !viewer_->picks()[0].values.empty(); }));
  EXPECT_EQ(viewer_->picks()[0].values[0].first, "node") << viewer_->picks()[0].values[0].second;
  display().press("F1");
  ASSERT_TRUE(until([&] { return viewer_->stage().pane().mode() == Mode::unstructured && viewer_->at_rest(); }));
  EXPECT_EQ(viewer_->picture().rgb, from_disk.rgb);
}

TEST_F(ViewerWindow, GoesOnWithoutThePartOfAnOctreeThatCannotBeRead) {
  EptFiles().write(folder_);
  std::filesystem::remove(folder_.path(EptFiles::node_file("r04", "binary")));
  start(8.0, folder_.path("ept.json"));
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->stage().unread().parts, 1u);
  EXPECT_EQ(viewer_->note(), "the picture is not complete: the panel says why");
  for (const auto& [key, mode] : {std::pair{"F2", Mode::hierarchical}, {"F5", Mode::lod}, {"F3", Mode::hybrid}}) {
    display().press(key);
    ASSERT_TRUE(until([&, wanted = mode] {
      EXPECT_TRUE(covered()) << "no frame is blank";
      return viewer_->stage().pane().mode() == wanted && viewer_->at_rest();
    })) << key;
    EXPECT_EQ(viewer_->stage().unread().parts, 1u) << key;
  }
  display().button(1, true);
  for (int i = 1; i <= 5; ++i) {
    display().move(kCentreX + 5 * i, kCentreY);
    steps(2);
    EXPECT_TRUE(covered()) << "no frame is blank";
  }
  display().button(1, false);
  ASSERT_TRUE(complete());
  // What needs all of the points cannot be had, and the picture stays
  display().press("F1");
  ASSERT_TRUE(until([&] { return !viewer_->stage().error().empty(); }));
  EXPECT_EQ(viewer_->stage().pane().mode(), Mode::hybrid);
  EXPECT_TRUE(covered());
}

TEST_F(ViewerWindow, BuildsAnOctreeInTheBackgroundAndOpensIt) {
  start();
  ASSERT_TRUE(complete());
  display().press("u");
  ASSERT_TRUE(until([&] { return viewer_->tree_job().running(); }));
  ASSERT_TRUE(until([&] { return !viewer_->tree_job().running(); }));
  EXPECT_EQ(viewer_->built_tree(), folder_.path("city.octree")) << viewer_->note();
  viewer_->open({viewer_->built_tree()});
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->stage().dataset()->info.point_count, kPoints);
  EXPECT_FALSE(viewer_->stage().dataset()->in_memory());
  display().press("u");
  steps(3);
  EXPECT_FALSE(viewer_->tree_job().running()) << "it is a tree already";

  // Cancelled, it leaves nothing
  viewer_->open({city_file(folder_, 2'000'000, "large.las")});
  ASSERT_TRUE(complete());
  viewer_->execute(Command::build_tree);
  viewer_->execute(Command::cancel);
  ASSERT_TRUE(until([&] { return !viewer_->tree_job().running(); }));
  EXPECT_EQ(viewer_->note(), "cancelled");
  EXPECT_FALSE(std::filesystem::exists(folder_.path("large.octree")));
}

TEST_F(ViewerWindow, KeysShowHideAndQuit) {
  start();
  ASSERT_TRUE(complete());
  display().press("p");
  steps(5);
  display().press("F12");
  steps(5);
  display().key("Control_L", true);
  display().press("q");
  display().key("Control_L", false);
  bool open = true;
  for (int i = 0; i < 100 && open; ++i) open = viewer_->step(0.01);
  EXPECT_FALSE(open);
  std::filesystem::remove("screenshot.png");
}

// With Mesa's software renderer on two cores, whatever the method but brute force.
TEST_F(ViewerWindow, ShowsMoreThanTwentyFramesASecondOnTheMove) {
#ifdef __SANITIZE_ADDRESS__
  GTEST_SKIP() << "sanitized code is too slow to be timed";
#endif
  const std::string autzen = std::string(STIPPLE_SHARED_DATA) + "/derived/autzen-stadium.laz";
  if (!std::filesystem::exists(autzen)) GTEST_SKIP() << autzen << " is missing: frames are not timed";
  window_.reset();
  window_.emplace(WindowOptions{.size = {1280, 720}, .errors_are_fatal = true});
  start(1.0, autzen);
  for (const auto& [key, mode] :
       {std::pair{"F3", Mode::hybrid}, std::pair{"F1", Mode::unstructured}, std::pair{"F2", Mode::hierarchical},
        std::pair{"F5", Mode::lod}, std::pair{"F6", Mode::subsample}}) {
    display().press(key);
    ASSERT_TRUE(until([&, wanted = mode] { return viewer_->stage().pane().mode() == wanted; }));
    display().move(900, 300);
    display().button(1, true);
    std::vector<double> seconds;
    for (int i = 1; i <= 80; ++i) {
      display().move(900 + 3 * i, 300 + i / 4);
      const double begin = window_->seconds();
      viewer_->step(0.01);
      if (i > 20) seconds.push_back(window_->seconds() - begin);
    }
    display().button(1, false);
    fmt::print("{}: {:.1f} ms a frame, coarser by {}\n", name_of(mode), 1e3 * median(seconds), viewer_->resolution());
    EXPECT_LT(median(seconds), 1.0 / 20.0) << key << ", coarser by " << viewer_->resolution();
  }
}

}  // namespace
}  // namespace stipple::test::window_viewer
