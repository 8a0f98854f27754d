#include "octree/select/frustum.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

namespace stipple::test::octree_frustum_test {
namespace {

constexpr int kTrials = 100'000;

struct RandomView {
  glm::dvec3 eye, right, up, forward;
  double half_x, half_y;

  Frustum frustum() const { return make_frustum(eye, right, up, forward, half_x, half_y); }
  bool sees(const glm::dvec3& point) const {
    const glm::dvec3 from_eye = point - eye;
    const double depth = glm::dot(forward, from_eye);
    return depth > 0.0 && std::abs(glm::dot(right, from_eye)) <= depth * std::tan(half_x) &&
           std::abs(glm::dot(up, from_eye)) <= depth * std::tan(half_y);
  }
};

class Scene {
 public:
  // World coordinates up to `magnitude` from the origin, boxes around the eye at all distances up to 1,000.
  Scene(unsigned seed, double magnitude) : random_(seed), magnitude_(magnitude) {}

  double uniform(double low, double high) { return std::uniform_real_distribution<double>(low, high)(random_); }
  glm::dvec3 vector(double reach) { return {uniform(-reach, reach), uniform(-reach, reach), uniform(-reach, reach)}; }

  RandomView view() {
    RandomView view;
    view.eye = vector(magnitude_);
    view.forward = glm::normalize(vector(1.0));
    view.right = glm::normalize(glm::cross(view.forward, vector(1.0)));
    view.up = glm::cross(view.right, view.forward);
    view.half_x = uniform(0.05, 1.5);
    view.half_y = uniform(0.05, 1.5);
    return view;
  }
  WorldBox box_near(const glm::dvec3& eye) {
    const glm::dvec3 centre = eye + vector(std::exp2(uniform(-3.0, 10.0)));
    const glm::dvec3 half = glm::abs(vector(std::exp2(uniform(-10.0, 8.0))));
    return {centre - half, centre + half};
  }
  glm::dvec3 point_in(const WorldBox& box) {
    return glm::mix(box.min, box.max, glm::dvec3(uniform(0.0, 1.0), uniform(0.0, 1.0), uniform(0.0, 1.0)));
  }

 private:
  std::mt19937 random_;
  double magnitude_;
};

TEST(Frustum, NeverCullsABoxWithAVisiblePoint) {
  for (const double magnitude : {10.0, 1e7}) {
    Scene scene(1, magnitude);
    int visible = 0;
    for (int i = 0; i < kTrials; ++i) {
      const RandomView view = scene.view();
      const WorldBox box = scene.box_near(view.eye);
      if (!view.sees(scene.point_in(box))) continue;
      ++visible;
      ASSERT_TRUE(may_see(view.frustum(), box));
    }
    EXPECT_GT(visible, kTrials / 20);
  }
}

TEST(Frustum, NeverCullsAPointOnItsBorder) {
  for (const double magnitude : {0.0, 1e3, 1e7}) {
    Scene scene(2, magnitude);
    for (int i = 0; i < kTrials; ++i) {
      const RandomView view = scene.view();
      const double depth = scene.uniform(0.0, 1'000.0);
      const double side = i % 2 ? 1.0 : -1.0;
      const glm::dvec3 point = view.eye + depth * (view.forward + side * std::tan(view.half_x) * view.right);
      ASSERT_TRUE(may_see(view.frustum(), {point, point}));
    }
  }
}

TEST(Frustum, CullsBoxesWhollyOutsideOneSide) {
  Scene scene(3, 1e6);
  for (int i = 0; i < kTrials; ++i) {
    const RandomView view = scene.view();
    const double half = scene.uniform(0.01, 10.0);
    const double clear = half * 2.0 + 0.1;  // more than half the diagonal
    const glm::dvec3 behind = view.eye - view.forward * clear;
    ASSERT_FALSE(may_see(view.frustum(), {behind - half, behind + half}));
    const glm::dvec3 border =
        view.eye + scene.uniform(0.0, 100.0) * (view.forward + std::tan(view.half_x) * view.right);
    const glm::dvec3 outwards = view.right * std::cos(view.half_x) - view.forward * std::sin(view.half_x);
    const glm::dvec3 beside = border + outwards * clear;
    ASSERT_FALSE(may_see(view.frustum(), {beside - half, beside + half}));
  }
}

TEST(Frustum, OfTwoEyesSeesWhatEitherDoes) {
  for (const double magnitude : {10.0, 1e7}) {
    Scene scene(5, magnitude);
    int visible = 0;
    for (int i = 0; i < kTrials; ++i) {
      const RandomView middle = scene.view();
      Frustum both = middle.frustum();
      both.to_side = middle.right * std::exp2(scene.uniform(-4.0, 6.0));
      const WorldBox box = scene.box_near(middle.eye);
      bool seen = false;
      double nearest = std::numeric_limits<double>::infinity();
      for (const double side : {-1.0, 1.0}) {
        RandomView eye = middle;
        eye.eye += side * both.to_side;
        seen = seen || eye.sees(scene.point_in(box));
        nearest = std::min(nearest, nearest_distance(eye.eye, box));
      }
      ASSERT_NEAR(nearest_distance(both, box), nearest, 1e-9 * (magnitude + nearest));
      if (!seen) continue;
      ++visible;
      ASSERT_TRUE(may_see(both, box));
    }
    EXPECT_GT(visible, kTrials / 20);
  }
}

TEST(Frustum, OfTwoEyesCullsWhatIsOutsideBoth) {
  Scene scene(6, 1e6);
  for (int i = 0; i < kTrials; ++i) {
    const RandomView middle = scene.view();
    Frustum both = middle.frustum();
    both.to_side = middle.right * scene.uniform(0.1, 10.0);
    const double half = scene.uniform(0.01, 10.0);
    const double clear = half * 2.0 + 0.1;  // more than half the diagonal
    const glm::dvec3 border = middle.eye + both.to_side +
                              scene.uniform(0.0, 100.0) * (middle.forward + std::tan(middle.half_x) * middle.right);
    const glm::dvec3 outwards = middle.right * std::cos(middle.half_x) - middle.forward * std::sin(middle.half_x);
    const glm::dvec3 beside = border + outwards * clear;
    ASSERT_FALSE(may_see(both, {beside - half, beside + half}));
  }
}

TEST(Frustum, SeesTheBoxAroundTheEye) {
  const Frustum frustum = make_frustum({1, 2, 3}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.01, 0.01);
  EXPECT_TRUE(may_see(frustum, {{0, 1, 2}, {2, 3, 4}}));
}

TEST(Frustum, DoesNotSeeAnEmptyBox) {
  const Frustum frustum = make_frustum({1, 2, 3}, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.5, 0.5);
  EXPECT_FALSE(may_see(frustum, WorldBox{}));
}

TEST(BoxDistance, BoundsTheDistanceOfEveryPointOfTheBox) {
  Scene scene(4, 10.0);
  for (int i = 0; i < kTrials; ++i) {
    const RandomView view = scene.view();
    const WorldBox box = scene.box_near(view.eye);
    const glm::dvec3 point = scene.point_in(box);
    const double distance = glm::distance(view.eye, point);
    const double slack = 1e-12 * (1.0 + distance);
    ASSERT_LE(nearest_distance(view.eye, box), distance + slack);
    ASSERT_GE(farthest_distance(view.eye, box), distance - slack);
    ASSERT_LE(nearest_depth(view.eye, view.forward, box), glm::dot(view.forward, point - view.eye) + slack);
  }
}

TEST(BoxDistance, IsThatOfTheClosestFaceAndTheFarthestCorner) {
  const WorldBox box{{1, 2, 3}, {4, 6, 8}};
  EXPECT_DOUBLE_EQ(nearest_distance({0, 4, 5}, box), 1.0);
  EXPECT_DOUBLE_EQ(nearest_distance({2, 4, 5}, box), 0.0);
  EXPECT_DOUBLE_EQ(farthest_distance({1, 2, 3}, box), std::sqrt(9.0 + 16.0 + 25.0));
  EXPECT_DOUBLE_EQ(nearest_depth({0, 0, 0}, {1, 0, 0}, box), 1.0);
  EXPECT_DOUBLE_EQ(nearest_depth({0, 0, 0}, {-1, 0, 0}, box), -4.0);
}

}  // namespace
}  // namespace stipple::test::octree_frustum_test
