#include "src/viewer/wires.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace stipple::test::viewer_wires {
namespace {

constexpr Grid kGrid{.offset = {500000, 5e6, 0}, .scale = glm::dvec3(0.01)};

View view_from(const glm::dvec3& eye, const glm::dvec3& target) {
  return make_view({.eye = eye, .target = target}, {320, 200}, 0.01);
}

TEST(Wires, ABoxHasTwelveEdgesOfItsStatesColour) {
  const View view = view_from({500000, 5e6 - 100, 10}, {500000, 5e6, 0});
  const SightedBox box{{{-1000, -1000, 0}, {1000, 1000, 500}}, SightedBox::State::occluded};
  const std::vector<WireEnd> wires = wires_of({box}, kGrid, view.eye, view);
  ASSERT_EQ(wires.size(), 24u);
  for (const WireEnd& end : wires) {
    EXPECT_EQ(end.rgba, kBoxColors[static_cast<std::size_t>(SightedBox::State::occluded)]);
    // Ten units around the target, which is a hundred away
    EXPECT_NEAR(end.clip.w, 100.0, 15.0);
    EXPECT_LT(std::abs(end.clip.x), end.clip.w);
  }
}

TEST(Wires, OfTooManyBoxesThoseNearestToWhereTheyWereFoundAreShown) {
  std::vector<SightedBox> boxes;
  for (int i = 0; i < static_cast<int>(kMostBoxes) + 100; ++i)
    boxes.push_back({{{0, 100 * i, 0}, {10, 100 * i + 10, 10}}, SightedBox::State::complete});
  std::ranges::reverse(boxes);
  const View from_outside = view_from({500000, 5e6 + 9000, 10}, {500000, 5e6, 0});
  const std::vector<WireEnd> wires = wires_of(boxes, kGrid, {500000, 5e6, 0}, from_outside);
  ASSERT_EQ(wires.size(), 24 * kMostBoxes);
  const auto nearest = std::ranges::min(wires, {}, [](const WireEnd& end) { return end.clip.w; });
  EXPECT_NEAR(nearest.clip.w, 9000.0 - static_cast<double>(kMostBoxes), 2.0);
}

TEST(Wires, ACameraIsAPyramidThatItSeesAsItsPicture) {
  const View view = view_from({500000, 5e6 - 100, 10}, {500000, 5e6, 0});
  const std::vector<WireEnd> wires = wires_of(view, 50.0, view);
  ASSERT_EQ(wires.size(), 16u);
  for (std::size_t i = 1; i < wires.size(); i += 4) {
    EXPECT_NEAR(std::abs(wires[i].clip.x), wires[i].clip.w, 1e-3);
    EXPECT_NEAR(std::abs(wires[i].clip.y), wires[i].clip.w, 1e-3);
    EXPECT_NEAR(wires[i].clip.w, 50.0, 1e-3);
  }
}

}  // namespace
}  // namespace stipple::test::viewer_wires
