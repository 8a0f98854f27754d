#include "src/viewer/rig.h"

#include <gtest/gtest.h>

namespace stipple::test::viewer_rig {
namespace {

constexpr glm::ivec2 kSize{1280, 720};
constexpr glm::dvec2 kCentre{640, 360};

// A field of 200 x 100 in UTM coordinates, seen from the south.
class RigTest : public testing::Test {
 protected:
  RigTest() { rig_.enter(box_, {.eye = {500100, 5e6 - 200, 150}, .target = {500100, 5e6 + 50, 0}}, 0.001); }
  double distance_to_pivot() const { return glm::distance(rig_.camera().eye, rig_.pivot()); }
  double height() const { return rig_.camera().eye.z; }
  glm::dvec2 pixel_of(const glm::dvec3& p) const {
    const View view = rig_.view(kSize);
    const glm::dvec3 r = p - view.eye;
    const double depth = glm::dot(view.forward, r);
    return {view.size.x / 2.0 * (1.0 + glm::dot(view.right, r) * view.cot_x / depth),
            view.size.y / 2.0 * (1.0 - glm::dot(view.up, r) * view.cot_y / depth)};
  }

  const WorldBox box_{{500000, 5e6, 0}, {500200, 5e6 + 100, 20}};
  Rig rig_;
};

TEST_F(RigTest, BeginsWithExactlyTheCameraItIsGiven) {
  const Camera camera{.eye = {1.5, 2.25, 3}, .target = {500100.1, 5e6 + 0.3, 1.7}, .fov_deg = 47.5};
  rig_.enter(box_, camera, 0.001);
  EXPECT_EQ(rig_.view(kSize), make_view(camera, kSize, 0.001));
  EXPECT_FALSE(rig_.moved());
  EXPECT_EQ(rig_.pivot(), glm::dvec3(500100, 5e6 + 50, 10));
}

TEST_F(RigTest, OrbitKeepsItsDistance) {
  const double before = distance_to_pivot();
  rig_.orbit(kCentre, kCentre + glm::dvec2(300, 50), kSize);
  EXPECT_NEAR(distance_to_pivot(), before, 1e-6);
  EXPECT_TRUE(rig_.moved());
}

TEST_F(RigTest, DraggingDownLooksFromHigherAndTheNearSideFollowsTheCursor) {
  const double before = height();
  rig_.orbit(kCentre, kCentre + glm::dvec2(0, 60), kSize);
  EXPECT_GT(height(), before);
  const glm::dvec3 near_side = rig_.pivot() - glm::dvec3(0, 50, 0);
  const double x = pixel_of(near_side).x;
  rig_.orbit(kCentre, kCentre + glm::dvec2(60, 0), kSize);
  EXPECT_GT(pixel_of(near_side).x, x);
}

TEST_F(RigTest, PanKeepsTheGrabbedPointUnderTheCursor) {
  const glm::dvec3 grabbed{500050, 5e6 + 20, 5};
  const glm::dvec2 at = pixel_of(grabbed);
  rig_.pan(at, at + glm::dvec2(100, -40), kSize, grabbed);
  EXPECT_NEAR(glm::distance(pixel_of(grabbed), at + glm::dvec2(100, -40)), 0.0, 1e-2);
}

TEST_F(RigTest, PanWithoutAPointGoesByThePivot) {
  const glm::dvec2 at = pixel_of(rig_.pivot());
  rig_.pan(at, at + glm::dvec2(30, 30), kSize, std::nullopt);
  EXPECT_NEAR(glm::distance(pixel_of(rig_.pivot()), at + glm::dvec2(30, 30)), 0.0, 1e-2);
}

TEST_F(RigTest, ZoomGoesToThePointUnderTheCursor) {
  const glm::dvec3 point{500150, 5e6 + 80, 3};
  const glm::dvec2 at = pixel_of(point);
  const double before = glm::distance(rig_.camera().eye, point);
  rig_.zoom(3.0, at, kSize, point);
  EXPECT_NEAR(glm::distance(pixel_of(point), at), 0.0, 1e-2);
  EXPECT_LT(glm::distance(rig_.camera().eye, point), 0.6 * before);
  rig_.zoom(-3.0, at, kSize, point);
  EXPECT_NEAR(glm::distance(rig_.camera().eye, point), before, 1e-6);
}

TEST_F(RigTest, TurningMovesWhatIsUnderTheCursorWithIt) {
  const glm::dvec3 eye = rig_.camera().eye;
  const glm::dvec3 point = eye + 100.0 * ray_through(rig_.view(kSize), kCentre);
  rig_.turn(kCentre, kCentre + glm::dvec2(50, 20), kSize);
  EXPECT_EQ(rig_.camera().eye, eye);
  EXPECT_NEAR(glm::distance(pixel_of(point), kCentre + glm::dvec2(50, 20)), 0.0, 15.0);
}

TEST_F(RigTest, FliesAsFarInASecondAsTheCloudIsAhead) {
  rig_.set_ahead(rig_.camera().eye + glm::dvec3(0, 40, 0));
  const glm::dvec3 eye = rig_.camera().eye;
  rig_.fly({0, 0, 1}, 0.5);
  EXPECT_NEAR(glm::distance(rig_.camera().eye, eye), 20.0, 1e-6);
}

TEST_F(RigTest, FacingShowsTheWholeBoxAndTurnsAroundItsMiddle) {
  rig_.set_pivot({0, 0, 0});
  rig_.face(0.0, -1.0, 16.0 / 9.0);
  EXPECT_EQ(rig_.pivot(), 0.5 * (box_.min + box_.max));
  for (const glm::dvec3& corner : {box_.min, box_.max}) {
    const glm::dvec2 pixel = pixel_of(corner);
    EXPECT_TRUE(pixel.x > 0 && pixel.x < kSize.x && pixel.y > 0 && pixel.y < kSize.y);
  }
}

TEST_F(RigTest, SurvivesAPictureOfOnePixelAndAnEmptyCloud) {
  rig_.enter({}, {}, 0.001);
  rig_.orbit({0, 0}, {1, 0}, {1, 1});
  rig_.pan({0, 0}, {1, 0}, {1, 1}, std::nullopt);
  rig_.zoom(5, {0, 0}, {1, 1}, std::nullopt);
  rig_.face(1, 1, 1);
  EXPECT_TRUE(std::isfinite(glm::length(rig_.camera().eye)));
}

}  // namespace
}  // namespace stipple::test::viewer_rig
