// What the viewer shows of a cloud: sizes, colours, sides, eyes, comparisons, boxes.
#include <filesystem>

#include "render/measure/psnr.h"
#include "tests/window/viewer_window.h"

namespace stipple::test::window_viewer_looks {
namespace {

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

}  // namespace
}  // namespace stipple::test::window_viewer_looks
