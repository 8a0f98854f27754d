#include "src/viewer/navigation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/constants.hpp>
#include <random>

namespace stipple::test::viewer_navigation {
namespace {

constexpr glm::ivec2 kSize{1280, 720};
constexpr int kTries = 10'000;

// Random poses over a survey in UTM coordinates.
class Navigation : public testing::Test {
 protected:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  Pose any_pose() {
    return {.eye = {number(4e5, 6e5), number(5e6, 6e6), number(-100, 3000)},
            .yaw = number(-3.1, 3.1),
            .pitch = number(-1.5, 1.5),
            .fov_deg = number(20, 100)};
  }
  glm::dvec2 any_pixel() { return {number(0, kSize.x), number(0, kSize.y)}; }
  static View view_of(const Pose& pose) { return make_view(camera_of(pose, 100.0), kSize, 0.001); }
  static glm::dvec2 pixel_of(const Pose& pose, const glm::dvec3& p) {
    const View view = view_of(pose);
    const glm::dvec3 r = p - view.eye;
    const double depth = glm::dot(view.forward, r);
    return {view.size.x / 2.0 * (1.0 + glm::dot(view.right, r) * view.cot_x / depth),
            view.size.y / 2.0 * (1.0 - glm::dot(view.up, r) * view.cot_y / depth)};
  }
  static void expect_near(const glm::dvec2& a, const glm::dvec2& b, double tolerance) {
    EXPECT_NEAR(a.x, b.x, tolerance);
    EXPECT_NEAR(a.y, b.y, tolerance);
  }

 private:
  std::mt19937 random_{1};
};

TEST_F(Navigation, AxesAreThoseOfTheView) {
  for (int i = 0; i < kTries; ++i) {
    const Pose pose = any_pose();
    const Axes axes = axes_of(pose);
    const View view = view_of(pose);
    EXPECT_NEAR(glm::distance(axes.right, view.right), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(axes.up, view.up), 0.0, 1e-9);
    EXPECT_NEAR(glm::distance(axes.forward, view.forward), 0.0, 1e-9);
  }
}

TEST_F(Navigation, AxesAreThoseOfTheViewStraightDownAndUp) {
  for (const double pitch : {-glm::half_pi<double>(), glm::half_pi<double>()})
    for (const double yaw : {-2.0, 0.0, 0.7}) {
      const Pose pose{.eye = {1, 2, 3}, .yaw = yaw, .pitch = pitch};
      EXPECT_NEAR(glm::distance(axes_of(pose).up, view_of(pose).up), 0.0, 1e-9);
      EXPECT_NEAR(glm::distance(axes_of(pose).right, view_of(pose).right), 0.0, 1e-9);
    }
}

TEST_F(Navigation, APoseComesBackFromItsCamera) {
  for (int i = 0; i < kTries; ++i) {
    Pose pose = any_pose();
    if (i % 10 == 0) pose.pitch = i % 20 ? glm::half_pi<double>() : -glm::half_pi<double>();
    const Pose back = pose_of(camera_of(pose, 50.0));
    EXPECT_EQ(back.eye, pose.eye);
    EXPECT_NEAR(back.yaw, pose.yaw, 1e-6);
    EXPECT_NEAR(back.pitch, pose.pitch, 1e-6);
    EXPECT_EQ(back.fov_deg, pose.fov_deg);
  }
}

TEST_F(Navigation, ARayLeadsThroughItsPixel) {
  for (int i = 0; i < kTries; ++i) {
    const Pose pose = any_pose();
    const glm::dvec2 pixel = any_pixel();
    expect_near(pixel_of(pose, pose.eye + 70.0 * ray_through(view_of(pose), pixel)), pixel, 1e-3);
  }
}

TEST_F(Navigation, OrbitKeepsTheDistanceToThePivotAndItsPlaceInThePicture) {
  for (int i = 0; i < kTries; ++i) {
    const Pose pose = any_pose();
    const glm::dvec3 pivot = pose.eye + number(1, 500) * ray_through(view_of(pose), any_pixel());
    const Pose next = orbited(pose, pivot, number(-2, 2), number(-2, 2));
    EXPECT_NEAR(glm::distance(next.eye, pivot), glm::distance(pose.eye, pivot), 1e-6);
    expect_near(pixel_of(next, pivot), pixel_of(pose, pivot), 1e-2);
  }
}

TEST_F(Navigation, OrbitStopsUprightAndNeverTurnsOver) {
  Pose pose = any_pose();
  for (int i = 0; i < 100; ++i) {
    pose = orbited(pose, pose.eye + 10.0 * axes_of(pose).forward, 0.1, 0.2);
    EXPECT_LE(pose.pitch, glm::half_pi<double>());
    EXPECT_GE(axes_of(pose).up.z, -1e-9);
  }
  EXPECT_EQ(pose.pitch, glm::half_pi<double>());
}

TEST_F(Navigation, AFullTurnComesBack) {
  const Pose start = any_pose();
  const glm::dvec3 pivot = start.eye + 30.0 * axes_of(start).forward;
  Pose pose = start;
  for (int i = 0; i < 360; ++i) pose = orbited(pose, pivot, glm::radians(1.0), 0.0);
  EXPECT_NEAR(glm::distance(pose.eye, start.eye), 0.0, 1e-5);
}

TEST_F(Navigation, PanMovesTheGrabbedPointWithTheCursor) {
  for (int i = 0; i < kTries; ++i) {
    const Pose pose = any_pose();
    const glm::dvec2 from = any_pixel();
    const glm::dvec2 to = any_pixel();
    const double depth = number(1, 1000);
    const glm::dvec3 grabbed = pose.eye + depth * ray_through(view_of(pose), from);
    expect_near(pixel_of(panned(pose, view_of(pose), depth, from, to), grabbed), to, 1e-2);
  }
}

TEST_F(Navigation, ZoomKeepsThePointUnderTheCursor) {
  for (int i = 0; i < kTries; ++i) {
    const Pose pose = any_pose();
    const glm::dvec2 pixel = any_pixel();
    const glm::dvec3 point = pose.eye + number(10, 1000) * ray_through(view_of(pose), pixel);
    const double factor = number(0.3, 3.0);
    const Pose next = zoomed(pose, point, factor, 0.01, 1e9);
    expect_near(pixel_of(next, point), pixel, 1e-2);
    EXPECT_NEAR(glm::distance(next.eye, point), factor * glm::distance(pose.eye, point), 1e-5);
  }
}

TEST_F(Navigation, ZoomStopsAtBothEnds) {
  Pose pose{.eye = {0, 0, 0}};
  const glm::dvec3 point{100, 0, 0};
  for (int i = 0; i < 100; ++i) pose = zoomed(pose, point, 0.5, 2.0, 1e4);
  EXPECT_NEAR(glm::distance(pose.eye, point), 2.0, 1e-9);
  for (int i = 0; i < 100; ++i) pose = zoomed(pose, point, 2.0, 2.0, 1e4);
  EXPECT_NEAR(glm::distance(pose.eye, point), 1e4, 1e-6);
  // Nearer than the limit already: it stays, and may leave
  const Pose close{.eye = {99, 0, 0}};
  EXPECT_EQ(zoomed(close, point, 0.5, 2.0, 1e4).eye, close.eye);
  EXPECT_NEAR(glm::distance(zoomed(close, point, 1.5, 2.0, 1e4).eye, point), 1.5, 1e-9);
}

TEST_F(Navigation, ZoomAtThePointItselfStays) {
  const Pose pose{.eye = {1, 2, 3}};
  EXPECT_EQ(zoomed(pose, pose.eye, 0.5, 1.0, 10.0), pose);
}

TEST_F(Navigation, TurningKeepsTheEye) {
  const Pose pose = any_pose();
  const Pose next = turned(pose, 0.3, -0.2);
  EXPECT_EQ(next.eye, pose.eye);
  EXPECT_NEAR(glm::dot(axes_of(next).forward, axes_of(pose).forward), 1.0, 0.1);
}

TEST_F(Navigation, FlyingForwardLeavesTheCentreInTheCentre) {
  const Pose pose = any_pose();
  const glm::dvec3 ahead = pose.eye + 100.0 * axes_of(pose).forward;
  expect_near(pixel_of(moved(pose, {0, 0, 40}), ahead), glm::dvec2(kSize) / 2.0, 1e-3);
}

TEST_F(Navigation, FacingABoxFillsThePictureWithIt) {
  for (int i = 0; i < kTries; ++i) {
    const glm::dvec3 corner{number(4e5, 6e5), number(5e6, 6e6), number(0, 100)};
    const WorldBox box{corner, corner + glm::dvec3(number(1, 1000), number(1, 1000), number(0, 200))};
    const double aspect = static_cast<double>(kSize.x) / kSize.y;
    const Pose pose = facing(box, number(-3, 3), number(-1.57, 1.57), 60.0, aspect);
    double farthest = 0.0;
    for (int c = 0; c < 8; ++c) {
      const glm::dvec3 p{c & 1 ? box.max.x : box.min.x, c & 2 ? box.max.y : box.min.y, c & 4 ? box.max.z : box.min.z};
      const glm::dvec2 place = pixel_of(pose, p) / (glm::dvec2(kSize) / 2.0) - 1.0;
      farthest = std::max({farthest, std::abs(place.x), std::abs(place.y)});
    }
    EXPECT_LE(farthest, 1.0);
    EXPECT_GE(farthest, 0.75);
  }
}

TEST_F(Navigation, FacingAPointOrNothingGivesAPose) {
  for (const WorldBox& box : {WorldBox{}, WorldBox{glm::dvec3(5.0), glm::dvec3(5.0)}})
    EXPECT_TRUE(std::isfinite(glm::length(facing(box, 0.0, -1.0, 60.0, 1.5).eye)));
}

}  // namespace
}  // namespace stipple::test::viewer_navigation
