#include "src/viewer/pointer.h"

#include <gtest/gtest.h>

namespace stipple::test::viewer_pointer {
namespace {

using Kind = Gesture::Kind;

TEST(Pointer, DragsMeanOrbitPanAndTurn) {
  const auto drag = [](MouseButton button, const Pointer::Modifiers& modifiers) {
    Pointer pointer;
    pointer.press(button, modifiers, {100, 100}, 0.0);
    return pointer.move({120, 90})->kind;
  };
  EXPECT_EQ(drag(MouseButton::left, {}), Kind::orbit);
  EXPECT_EQ(drag(MouseButton::right, {}), Kind::pan);
  EXPECT_EQ(drag(MouseButton::middle, {}), Kind::turn);
  EXPECT_EQ(drag(MouseButton::left, {.shift = true}), Kind::pan);
  EXPECT_EQ(drag(MouseButton::left, {.alt = true}), Kind::turn);
}

TEST(Pointer, ADragGoesFromPlaceToPlaceAndLosesNothing) {
  Pointer pointer;
  pointer.press(MouseButton::left, {}, {100, 100}, 0.0);
  EXPECT_FALSE(pointer.move({102, 101}));  // within a click
  const auto first = pointer.move({110, 100});
  ASSERT_TRUE(first);
  EXPECT_EQ(first->from, glm::dvec2(100, 100));
  EXPECT_EQ(first->to, glm::dvec2(110, 100));
  EXPECT_EQ(pointer.move({111, 100})->from, glm::dvec2(110, 100));
  EXPECT_FALSE(pointer.release(MouseButton::left, {111, 100}, 0.1));
  EXPECT_FALSE(pointer.move({150, 100}));
}

TEST(Pointer, AClickIsShortAndStill) {
  Pointer pointer;
  pointer.press(MouseButton::left, {}, {5, 6}, 1.0);
  const auto click = pointer.release(MouseButton::left, {7, 6}, 1.1);
  ASSERT_TRUE(click);
  EXPECT_EQ(click->kind, Kind::click);
  EXPECT_EQ(click->from, glm::dvec2(5, 6));
  pointer.press(MouseButton::left, {}, {5, 6}, 5.0);
  EXPECT_FALSE(pointer.release(MouseButton::left, {5, 6}, 6.0)) << "held for a second";
}

TEST(Pointer, TwoClicksSoonAfterEachOtherAreOneDoubleClick) {
  const auto second = [](const glm::dvec2& place, double seconds) {
    Pointer pointer;
    pointer.press(MouseButton::left, {}, {50, 50}, 0.0);
    pointer.release(MouseButton::left, {50, 50}, 0.05);
    pointer.press(MouseButton::left, {}, place, seconds);
    return pointer.release(MouseButton::left, place, seconds + 0.05)->kind;
  };
  EXPECT_EQ(second({51, 50}, 0.2), Kind::double_click);
  EXPECT_EQ(second({51, 50}, 0.9), Kind::click);
  EXPECT_EQ(second({90, 50}, 0.2), Kind::click);
}

TEST(Pointer, AThirdClickBeginsAnew) {
  Pointer pointer;
  Kind last = Kind::orbit;
  for (int click = 0; click < 3; ++click) {
    pointer.press(MouseButton::left, {}, {50, 50}, 0.1 * click);
    last = pointer.release(MouseButton::left, {50, 50}, 0.1 * click + 0.05)->kind;
  }
  EXPECT_EQ(last, Kind::click);
}

TEST(Pointer, ASecondButtonDoesNotDisturbADrag) {
  Pointer pointer;
  pointer.press(MouseButton::left, {}, {0, 0}, 0.0);
  pointer.move({20, 0});
  pointer.press(MouseButton::right, {}, {20, 0}, 0.1);
  EXPECT_FALSE(pointer.release(MouseButton::right, {20, 0}, 0.2));
  EXPECT_EQ(pointer.move({30, 0})->kind, Kind::orbit);
  EXPECT_TRUE(pointer.holds());
}

TEST(Pointer, AReleaseWithoutAPressIsNothing) {
  Pointer pointer;
  EXPECT_FALSE(pointer.release(MouseButton::left, {1, 1}, 0.0));
  EXPECT_FALSE(pointer.move({2, 2}));
}

}  // namespace
}  // namespace stipple::test::viewer_pointer
