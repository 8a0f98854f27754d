// The viewer as it is used: a real window on a display of its own, with real input.
#include "src/viewer/viewer.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <functional>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "render/measure/image.h"
#include "render/measure/psnr.h"
#include "src/camera/camera_file.h"
#include "src/run/median.h"
#include "tests/command/run_stipple.h"
#include "tests/window/x_display.h"

namespace stipple::test::window_viewer {
namespace {

constexpr std::uint64_t kPoints = 60'000;
constexpr glm::ivec2 kSize{640, 400};
constexpr int kCentreX = 480;  // right of the panel, where points are
constexpr int kCentreY = 130;

const XDisplay& display() {
  static const XDisplay one;
  return one;
}

class ViewerWindow : public testing::Test {
 protected:
  void SetUp() override {
    if (!display().running()) GTEST_SKIP() << "Xvfb is missing (apt install xvfb): the window is not tested";
    display().move(kCentreX, kCentreY);
    window_.emplace(WindowOptions{.size = kSize, .errors_are_fatal = true});
  }
  void TearDown() override {
    viewer_.reset();
    window_.reset();
  }

  void start(double point_size = 1.0, const std::string& input = "") {
    ViewerOptions options;
    options.inputs = {input.empty() ? city_ : input};
    options.point_size = point_size;
    options.policy.frames_per_second = 30.0;
    viewer_.emplace(*window_, std::move(options));
  }
  // Goes on until it is so.
  [[nodiscard]] bool until(const std::function<bool()>& so) {
    for (int i = 0; i < 3000; ++i) {
      if (so()) return true;
      viewer_->step(0.01);
    }
    return false;
  }
  [[nodiscard]] bool complete() {
    steps(2);  // what has just happened is seen by then
    return until([&] { return viewer_->stage().complete(viewer_->view()) && viewer_->at_rest(); });
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) viewer_->step(0.01);
  }
  bool covered() {
    const Image image = viewer_->picture();
    const auto grey = std::ranges::count(image.rgb, std::uint8_t{0x80});
    return static_cast<std::size_t>(grey) < image.rgb.size() * 99 / 100;
  }
  // What `stipple render` makes of the command in the clipboard.
  Image headless() {
    viewer_->execute(Command::copy_command);
    std::string command = window_->clipboard();
    EXPECT_TRUE(command.starts_with("stipple render "));
    const std::string picture = folder_.path("headless.png");
    command.replace(command.find("view.png"), 8, picture);
    const Outcome outcome = run_stipple(folder_, command.substr(8));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_png(picture);
  }

  const ScratchFolder folder_;
  const std::string city_ = city_file(folder_, kPoints);
  std::optional<Window> window_;
  std::optional<Viewer> viewer_;
};

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

TEST_F(ViewerWindow, PointsGrowAndShrinkAndPicksAreForgotten) {
  start();
  ASSERT_TRUE(complete());
  const Image small = viewer_->picture();
  display().press("KP_Add");
  ASSERT_TRUE(until([&] { return viewer_->settings().point_size == 2.0; }));
  ASSERT_TRUE(complete());
  EXPECT_NE(viewer_->picture().rgb, small.rgb);
  EXPECT_EQ(viewer_->picture().rgb, headless().rgb);
  display().click(1);
  ASSERT_TRUE(until([&] { return !viewer_->picks().empty(); }));
  display().press("x");
  ASSERT_TRUE(until([&] { return viewer_->picks().empty(); }));
  display().press("KP_Subtract");
  ASSERT_TRUE(until([&] { return viewer_->settings().point_size == 1.0; }));
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->picture().rgb, small.rgb);
}

TEST_F(ViewerWindow, SplatsAppearGrowAndVanish) {
  start();
  ASSERT_TRUE(complete());
  const Image without = viewer_->picture();
  display().press("bracketright");
  ASSERT_TRUE(until([&] { return viewer_->point_size().world > 0.0; }));
  const double first = viewer_->point_size().world;
  display().press("bracketright");
  ASSERT_TRUE(until([&] { return viewer_->point_size().world == 2.0 * first; }));
  ASSERT_TRUE(complete());
  EXPECT_NE(viewer_->picture().rgb, without.rgb);
  EXPECT_EQ(viewer_->picture().rgb, headless().rgb);
  display().press("bracketleft");
  display().press("bracketleft");
  ASSERT_TRUE(until([&] { return viewer_->point_size().world == 0.0; }));
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->picture().rgb, without.rgb);
}

TEST_F(ViewerWindow, ShowsTwoMethodsSideBySideWithOneCamera) {
  start(2.0);
  ASSERT_TRUE(complete());
  const Image alone = viewer_->picture();
  display().press("v");
  ASSERT_TRUE(until([&] { return viewer_->stage().frame(Stage::right) != nullptr; }));
  ASSERT_TRUE(complete());
  EXPECT_NE(viewer_->stage().pane(Stage::left).mode(), viewer_->stage().pane(Stage::right).mode());
  EXPECT_EQ(viewer_->picture().rgb, alone.rgb) << "both converge to one picture";

  // The line is moved, not the camera
  const Camera before = viewer_->rig().camera();
  display().move(kSize.x / 2, 300);
  steps(2);
  display().button(1, true);
  display().move(kSize.x / 2 + 100, 300);
  steps(3);
  display().button(1, false);
  steps(3);
  EXPECT_EQ(viewer_->rig().camera().eye, before.eye);
  EXPECT_EQ(viewer_->divider_column(), kSize.x / 2 + 100);
  // What both have left to draw is the same no more once the camera moves; on the way either side shows something
  display().move(kCentreX, kCentreY);
  display().button(1, true);
  for (int i = 1; i <= 5; ++i) {
    display().move(kCentreX + 8 * i, kCentreY);
    steps(1);
    EXPECT_TRUE(covered());
  }
  display().button(1, false);

  display().key("Shift_L", true);
  display().press("F2");
  display().key("Shift_L", false);
  ASSERT_TRUE(until([&] { return viewer_->stage().pane(Stage::right).mode() == Mode::hierarchical; }));
  EXPECT_EQ(viewer_->stage().pane(Stage::left).mode(), Mode::hybrid);
  ASSERT_TRUE(complete());
  display().press("b");
  steps(3);
  const Image left = viewer_->picture();
  display().press("b");
  steps(3);
  EXPECT_EQ(viewer_->picture().rgb, left.rgb);
  EXPECT_EQ(left.rgb, headless().rgb);
}

TEST_F(ViewerWindow, ShowsTwoEyesSideBySide) {
  start(2.0);
  ASSERT_TRUE(complete());
  const Image one = viewer_->picture();
  display().press("y");
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->view().eyes(), 2u);
  const Image both = viewer_->picture();
  EXPECT_EQ(both.size, kSize);
  EXPECT_EQ(both.rgb, headless().rgb);

  display().press("o");
  steps(5);
  EXPECT_NE(viewer_->picture().rgb, both.rgb) << "boxes";
  display().press("o");
  steps(5);
  EXPECT_EQ(viewer_->picture().rgb, both.rgb);

  // The same point is picked in either eye's picture
  const auto picked = [&](int x) {
    const std::size_t before = viewer_->picks().size();
    display().move(x, kCentreY);
    display().button(1, true);
    display().button(1, false);
    EXPECT_TRUE(until([&] { return viewer_->picks().size() > before; }));
    return viewer_->picks().back().world;
  };
  const glm::dvec3 point = picked(kCentreX);
  const View right = viewer_->view().of_eye(1);
  const glm::dvec3 r = point - right.eye;
  const double depth = glm::dot(right.forward, r);
  EXPECT_NEAR(160.0 * (1.0 + glm::dot(right.right, r) * right.cot_x / depth), kCentreX - 320, 9.0);
  EXPECT_NEAR(200.0 * (1.0 - glm::dot(right.up, r) * right.cot_y / depth), kCentreY, 9.0);

  display().press("v");  // takes the place of two eyes
  ASSERT_TRUE(until([&] { return viewer_->stage().frame(Stage::right) != nullptr; }));
  EXPECT_FALSE(viewer_->shows_two_eyes());
  display().press("y");
  EXPECT_TRUE(until([&] { return viewer_->shows_two_eyes(); }));
  EXPECT_FALSE(viewer_->stage().is_split());
  display().press("y");
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->picture().rgb, one.rgb);
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

TEST_F(ViewerWindow, EveryColourIsThatOfRenderAndIsGivenToWhatIsThere) {
  start(2.0);
  ASSERT_TRUE(complete());
  const std::uint64_t drawn = viewer_->stage().frames();
  for (int i = 0; i < 3; ++i) {
    const std::string before = viewer_->stage().dataset()->colors.attribute;
    display().press("c");
    ASSERT_TRUE(until([&] { return viewer_->stage().dataset()->colors.attribute != before; }));
    ASSERT_TRUE(complete());
    EXPECT_EQ(viewer_->picture().rgb, headless().rgb) << viewer_->stage().dataset()->colors.attribute;
    EXPECT_EQ(viewer_->stage().color_bytes(), 4 * kPoints);
  }
  EXPECT_EQ(viewer_->stage().frames(), drawn) << "the picture is not drawn again";
}

// Those on screen and those that were made before, in the middle of a picture as well.
TEST_F(ViewerWindow, EveryMethodTakesOtherColours) {
  start(2.0);
  ASSERT_TRUE(complete());
  for (const char* key : {"F1", "F2", "F4", "F5", "F6"}) {
    display().press(key);
    ASSERT_TRUE(complete()) << key;
  }
  display().press("v");
  ASSERT_TRUE(complete());
  const auto attribute = [&] { return viewer_->stage().dataset()->colors.attribute; };
  const std::string before = attribute();
  viewer_->execute(Command::again);
  viewer_->execute(Command::next_color);
  ASSERT_TRUE(until([&] {
    viewer_->execute(Command::again);
    return attribute() != before;
  }));
  ASSERT_TRUE(complete());
  display().press("v");
  const Image rendered = headless();
  for (const char* key : {"F2", "F1", "F4", "F6", "F3"}) {
    display().press(key);
    ASSERT_TRUE(complete()) << key;
    EXPECT_EQ(viewer_->picture().rgb, rendered.rgb) << key;
  }
}

TEST_F(ViewerWindow, AChangeOfColoursIsCancelledOrTakenOverByTheNext) {
  start(2.0);
  ASSERT_TRUE(complete());
  const std::vector<std::string> names = colors_of(*viewer_->stage().info());
  const std::string before = viewer_->stage().dataset()->colors.attribute;
  ASSERT_EQ(before, names[0]);
  viewer_->execute(Command::next_color);
  viewer_->execute(Command::cancel);
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->note(), "cancelled");
  EXPECT_EQ(viewer_->stage().dataset()->colors.attribute, before);
  EXPECT_EQ(viewer_->stage().error(), "");
  for (int i = 0; i < 3; ++i) viewer_->execute(Command::next_color);
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->stage().dataset()->colors.attribute, names[3]);
  EXPECT_EQ(viewer_->picture().rgb, headless().rgb);
}

TEST_F(ViewerWindow, EyeDomeLightingShadesWhatIsShownAndNothingElse) {
  start(2.0);
  ASSERT_TRUE(complete());
  const Image plain = viewer_->picture();
  const std::uint64_t drawn = viewer_->stage().frames();
  display().press("l");
  steps(5);
  const Image shaded = viewer_->picture();
  EXPECT_NE(shaded.rgb, plain.rgb);
  EXPECT_EQ(shaded.rgb, headless().rgb);
  // Two sides are shaded alike
  display().press("v");
  ASSERT_TRUE(until([&] { return viewer_->stage().frame(Stage::right) != nullptr; }));
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->picture().rgb, shaded.rgb);
  display().press("v");
  steps(3);
  const std::uint64_t drawn_by_both = viewer_->stage().frames();
  EXPECT_GT(drawn_by_both, drawn);
  display().press("l");
  steps(5);
  EXPECT_EQ(viewer_->picture().rgb, plain.rgb);
  EXPECT_EQ(viewer_->stage().frames(), drawn_by_both) << "nothing is drawn for it";
}

TEST_F(ViewerWindow, ShowsWhereAndHowMuchThePictureDiffersFromTheReference) {
  start(2.0);
  ASSERT_TRUE(complete());
  const Image picture = viewer_->picture();
  display().press("g");
  const ReferenceComparison& comparison = viewer_->comparison();
  ASSERT_TRUE(until([&] { return comparison.reference_of(viewer_->view()) && viewer_->at_rest(); }));
  EXPECT_NE(viewer_->picture().rgb, picture.rgb);
  display().press("g");
  steps(5);
  ASSERT_EQ(comparison.shown(), ReferenceComparison::Shown::reference);
  const Image reference = viewer_->picture();
  ASSERT_FALSE(comparison.curve(Stage::left).empty());
  EXPECT_DOUBLE_EQ(comparison.curve(Stage::left).back().psnr_db, psnr_db(mean_squared_error(picture, reference)));

  // From nothing, on both sides: the error falls until it is what it was
  display().press("v");
  ASSERT_TRUE(until([&] { return viewer_->stage().frame(Stage::right) != nullptr; }));
  ASSERT_TRUE(complete());
  display().press("n");
  ASSERT_TRUE(complete());
  for (const auto side : {Stage::left, Stage::right}) {
    const ReferenceComparison::Curve& curve = comparison.curve(side);
    ASSERT_FALSE(curve.empty());
    EXPECT_DOUBLE_EQ(curve.back().psnr_db, psnr_db(mean_squared_error(picture, reference)));
    EXPECT_TRUE(std::ranges::is_sorted(curve, {}, &ReferenceComparison::Sample::seconds));
  }

  // Another view has another reference, in its time
  display().press("1");
  ASSERT_TRUE(complete());
  EXPECT_TRUE(comparison.reference_of(viewer_->view()));
  display().press("g");
  steps(5);
  EXPECT_FALSE(comparison.on());
  EXPECT_EQ(viewer_->picture().rgb, headless().rgb);
}

TEST_F(ViewerWindow, KeepsWhatWasSelectedWhileTheCameraMovesFreely) {
  start(2.0);
  ASSERT_TRUE(complete());
  const Image before = viewer_->picture();
  const auto inked = [](const Image& image) {
    return static_cast<std::size_t>(std::ranges::count_if(image.rgb, [](std::uint8_t v) { return v != 0x80; }));
  };
  display().press("f");
  ASSERT_TRUE(complete());
  EXPECT_TRUE(viewer_->stage().frozen());
  display().press("1");
  ASSERT_TRUE(complete());
  const Image outside = viewer_->picture();
  EXPECT_GT(inked(outside), 1000u);
  const std::uint64_t filled = viewer_->stage().filled();
  EXPECT_EQ(filled, 0u) << "nothing new is selected";
  display().press("f");
  ASSERT_TRUE(complete());
  EXPECT_GT(inked(viewer_->picture()), inked(outside)) << "what was hidden before";
  EXPECT_EQ(viewer_->picture().rgb, headless().rgb);
  display().press("h");
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->picture().rgb, before.rgb);
}

TEST_F(ViewerWindow, ShowsBoxesOfWhatIsDrawnFrom) {
  start();
  ASSERT_TRUE(complete());
  const Image plain = viewer_->picture();
  for (const char* method : {"F3", "F2"}) {
    display().press(method);
    ASSERT_TRUE(complete());
    const std::vector<SightedBox> boxes = viewer_->stage().pane().boxes();
    EXPECT_GT(boxes.size(), 10u) << method;
    for (const SightedBox& box : boxes)
      EXPECT_TRUE(box.state == SightedBox::State::complete || box.state == SightedBox::State::occluded) << method;
    display().press("o");
    steps(5);
    EXPECT_NE(viewer_->picture().rgb, plain.rgb) << method;
    display().press("o");
    steps(5);
    EXPECT_EQ(viewer_->picture().rgb, plain.rgb) << method;
  }
}

TEST_F(ViewerWindow, HidesTheClassOfAPickedPointAndShowsItAgain) {
  start(4.0);
  ASSERT_TRUE(complete());
  const Image whole = viewer_->picture();
  display().click(1);
  ASSERT_TRUE(until([&] { return !viewer_->picks().empty() && !viewer_->picks()[0].values.empty(); }));
  const std::uint32_t id = viewer_->picks()[0].pixel.id;
  display().press("k");
  const auto hidden = [&] { return viewer_->stage().dataset()->colors.hidden.count(); };
  ASSERT_TRUE(until([&] {
    EXPECT_TRUE(covered()) << "no frame is blank";
    return hidden() == 1;
  }));
  ASSERT_TRUE(complete());
  display().click(1);
  steps(10);
  for (const Pick& pick : viewer_->picks()) EXPECT_NE(pick.pixel.id, id);
  EXPECT_EQ(viewer_->picture().rgb, headless().rgb);
  // Without the file: its classes are known, and so are the colours that were hidden
  std::filesystem::remove(city_);
  display().press("x");
  display().press("k");
  ASSERT_TRUE(until([&] { return hidden() == 0; }));
  ASSERT_TRUE(complete());
  EXPECT_EQ(viewer_->picture().rgb, whole.rgb);
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

TEST(ViewCommand, TakesAScreenshotAndEnds) {
  if (!display().running()) GTEST_SKIP() << "Xvfb is missing (apt install xvfb): the window is not tested";
  const ScratchFolder folder;
  const std::string city = city_file(folder, kPoints);
  const std::string common = city + " --size 320x200 --mode unstructured ";
  const Outcome view =
      run_stipple(folder, "view " + common + "--screenshot " + folder.path("window.png") + " --exit-after-screenshot");
  ASSERT_EQ(view.code, 0) << view.err;
  ASSERT_EQ(run_stipple(folder, "render " + common + "-o " + folder.path("file.png")).code, 0);
  EXPECT_EQ(read_png(folder.path("window.png")).rgb, read_png(folder.path("file.png")).rgb);
}

TEST(ViewCommand, TakesAScreenshotOfAnotherSizeThanTheWindows) {
  if (!display().running()) GTEST_SKIP() << "Xvfb is missing (apt install xvfb): the window is not tested";
  const ScratchFolder folder;
  const std::string city = city_file(folder, kPoints);
  std::ofstream(folder.path("camera.json")) << R"({"eye": [565160, 5934080, 120], "target": [565330, 5934420, 0]})";
  const std::string common = city + " --edl --camera " + folder.path("camera.json");
  const Outcome view =
      run_stipple(folder, "view " + common + " --size 320x200 --screenshot-size 500x700 --screenshot " +
                              folder.path("window.png") + " --exit-after-screenshot");
  ASSERT_EQ(view.code, 0) << view.err;
  ASSERT_EQ(run_stipple(folder, "render " + common + " --size 500x700 -o " + folder.path("file.png")).code, 0);
  EXPECT_EQ(read_png(folder.path("window.png")).size, glm::ivec2(500, 700));
  EXPECT_EQ(read_png(folder.path("window.png")).rgb, read_png(folder.path("file.png")).rgb);
}

TEST(ViewCommand, PicturesTheWindowAsItIs) {
  if (!display().running()) GTEST_SKIP() << "Xvfb is missing (apt install xvfb): the window is not tested";
  const ScratchFolder folder;
  const std::string city = city_file(folder, kPoints);
  const std::string picture = folder.path("window.png");
  const Outcome view = run_stipple(
      folder, "view " + city + " --size 640x400 --screenshot " + picture + " --with-panels --exit-after-screenshot");
  ASSERT_EQ(view.code, 0) << view.err;
  const Image image = read_png(picture);
  ASSERT_EQ(image.size, glm::ivec2(640, 400));
  // Dark where the panel is, grey in the upper right corner
  const std::size_t in_panel = 3 * (20 * 640 + 285);
  EXPECT_LT(image.rgb[in_panel], 0x50);
  EXPECT_EQ(image.rgb[3 * (5 * 640 + 635)], 0x80);
}

TEST(ViewCommand, SaysWhatToDoWithoutADisplay) {
  const ScratchFolder folder;
  const std::string city = city_file(folder, 1'000);
  const std::string saved = std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "";
  ::unsetenv("DISPLAY");
  const Outcome outcome = run_stipple(folder, "view " + city);
  if (!saved.empty()) ::setenv("DISPLAY", saved.c_str(), 1);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("xvfb-run"), std::string::npos);
  EXPECT_EQ(run_stipple(folder, "view " + folder.path("none.las")).code, 1);
  EXPECT_EQ(run_stipple(folder, "view " + city + " --mode reference").code, 2);
  EXPECT_EQ(run_stipple(folder, "view " + city + " --exit-after-screenshot").code, 2);
}

}  // namespace
}  // namespace stipple::test::window_viewer
