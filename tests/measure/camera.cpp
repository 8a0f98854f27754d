#include "render/frame/camera.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "octree/core/error.h"

namespace stipple::test::measure_camera {
namespace {

constexpr double kNear = 0.01;

// The formula of View, written out once more.
glm::dvec2 pixel_of(const View& view, const glm::dvec3& p) {
  const glm::dvec3 r = p - view.eye;
  const double depth = glm::dot(view.forward, r);
  return {view.size.x / 2.0 * (1.0 + glm::dot(view.right, r) * view.cot_x / depth),
          view.size.y / 2.0 * (1.0 - glm::dot(view.up, r) * view.cot_y / depth)};
}

void expect_orthonormal(const View& view, double tolerance) {
  EXPECT_NEAR(glm::length(view.right), 1.0, tolerance);
  EXPECT_NEAR(glm::length(view.up), 1.0, tolerance);
  EXPECT_NEAR(glm::length(view.forward), 1.0, tolerance);
  EXPECT_NEAR(glm::dot(view.right, view.up), 0.0, tolerance);
  EXPECT_NEAR(glm::dot(view.up, view.forward), 0.0, tolerance);
  EXPECT_NEAR(glm::dot(view.forward, view.right), 0.0, tolerance);
  EXPECT_GT(glm::dot(glm::cross(view.right, view.forward), view.up), 0.0);  // right-handed
}

TEST(MakeView, BasisIsOrthonormalAndTheTargetIsInTheCentre) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> number(-1e6, 1e6);
  const auto vector = [&] { return glm::dvec3(number(random), number(random), number(random)); };
  for (int i = 0; i < 100'000; ++i) {
    const Camera camera{vector(), vector(), vector(), 1.0 + std::abs(number(random)) * 1.7e-4};
    const View view = make_view(camera, {1280, 720}, kNear);
    expect_orthonormal(view, 1e-9);
    EXPECT_GE(glm::dot(view.up, camera.up), 0.0);
    const glm::dvec2 centre = pixel_of(view, camera.target);
    EXPECT_NEAR(centre.x, 640.0, 1e-6);
    EXPECT_NEAR(centre.y, 360.0, 1e-6);
  }
}

TEST(MakeView, FieldOfViewIsVerticalAndPixelsAreSquare) {
  const View view = make_view({{0, 0, 0}, {0, 10, 0}, {0, 0, 1}, 90.0}, {200, 100}, kNear);
  // At 90 degrees the upper edge is as far from the axis as the picture plane from the eye
  EXPECT_NEAR(pixel_of(view, {0, 10, 10}).y, 0.0, 1e-12);
  EXPECT_NEAR(pixel_of(view, {0, 10, -10}).y, 100.0, 1e-12);
  EXPECT_NEAR(pixel_of(view, {20, 10, 0}).x, 200.0, 1e-12);
  EXPECT_NEAR(view.pixel_size(10.0), 0.2, 1e-15);
  const glm::dvec2 step = pixel_of(view, {0.2, 10, 0.2}) - pixel_of(view, {0, 10, 0});
  EXPECT_NEAR(step.x, 1.0, 1e-12);
  EXPECT_NEAR(step.y, -1.0, 1e-12);
}

TEST(MakeView, UpAlongTheLineOfSightIsReplacedByTheFarthestAxis) {
  const View down = make_view({{0, 0, 9}, {0, 0, 0}, {0, 0, 1}, 60.0}, {4, 4}, kNear);
  EXPECT_EQ(down.up, glm::dvec3(0, 1, 0));
  EXPECT_EQ(down.right, glm::dvec3(1, 0, 0));
  const View along_y = make_view({{0, 0, 0}, {0, 5, 0}, {0, -2, 0}, 60.0}, {4, 4}, kNear);
  EXPECT_EQ(along_y.up, glm::dvec3(0, 0, 1));
  const View slanted = make_view({{0, 0, 0}, {1, 2, 3}, {-2, -4, -6}, 60.0}, {4, 4}, kNear);
  expect_orthonormal(slanted, 1e-15);
  EXPECT_GT(slanted.up.x, 0.0);
  EXPECT_NEAR(slanted.right.x, 0.0, 1e-15);
  expect_orthonormal(make_view({{0, 0, 0}, {1, 2, 3}, {0, 0, 0}, 60.0}, {4, 4}, kNear), 1e-15);
}

TEST(MakeView, ImpossibleCamerasAreUsageErrors) {
  const double infinity = std::numeric_limits<double>::infinity();
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Camera good;
  EXPECT_NO_THROW(make_view(good, {1, 1}, kNear));
  EXPECT_THROW(make_view({{1, 2, 3}, {1, 2, 3}}, {8, 8}, kNear), UsageError);
  EXPECT_THROW(make_view({{nan, 0, 0}}, {8, 8}, kNear), UsageError);
  EXPECT_THROW(make_view({{0, 0, 0}, {infinity, 0, 0}}, {8, 8}, kNear), UsageError);
  for (const double fov : {0.0, -1.0, 180.0, 720.0, nan})
    EXPECT_THROW(make_view({{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, fov}, {8, 8}, kNear), UsageError);
  for (const glm::ivec2 size : {glm::ivec2{0, 8}, {8, 0}, {-8, 8}})
    EXPECT_THROW(make_view(good, size, kNear), UsageError);
  for (const double near : {0.0, -1.0, infinity, nan}) EXPECT_THROW(make_view(good, {8, 8}, near), UsageError);
}

}  // namespace
}  // namespace stipple::test::measure_camera
