#include "render/frame/budget.h"

#include <gtest/gtest.h>

#include <random>

namespace stipple::test::measure_budget {
namespace {

// A machine that needs `fixed` ms a frame and `per_million` ms for a million points.
struct Machine {
  double fixed;
  double per_million;
  double frame(std::uint32_t points) const { return fixed + per_million * points / 1e6; }
};

TEST(Budget, ReachesTheTargetWithinTwelveFrames) {
  for (const double target : {16.0, 33.0, 66.0}) {
    const Machine machine{5.0, 40.0};
    BudgetController controller(target, 10'000, {});
    for (int i = 0; i < 12; ++i) controller.frame_done(controller.budget(), machine.frame(controller.budget()));
    EXPECT_NEAR(machine.frame(controller.budget()), target, 0.05 * target) << target;
  }
}

TEST(Budget, FollowsACostThatDoublesWithinEightFrames) {
  BudgetController controller(33.0, 500'000, {});
  for (int i = 0; i < 20; ++i) controller.frame_done(controller.budget(), Machine{5, 40}.frame(controller.budget()));
  for (int i = 0; i < 8; ++i) controller.frame_done(controller.budget(), Machine{10, 80}.frame(controller.budget()));
  EXPECT_NEAR((Machine{10, 80}.frame(controller.budget())), 33.0, 3.3);
}

TEST(Budget, StaysNearTheTargetUnderNoise) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> noise(0.9, 1.1);
  const Machine machine{5.0, 40.0};
  BudgetController controller(33.0, 500'000, {});
  for (int i = 0; i < 200; ++i) {
    controller.frame_done(controller.budget(), machine.frame(controller.budget()) * noise(random));
    if (i > 10) {
      EXPECT_NEAR(machine.frame(controller.budget()), 33.0, 5.0) << i;
    }
  }
}

TEST(Budget, KeepsItsLimitsWhenTheTargetCannotBeReached) {
  BudgetController slow(10.0, 500'000, {2'000, 1'000'000});
  BudgetController quick(10.0, 500'000, {2'000, 1'000'000});
  for (int i = 0; i < 50; ++i) slow.frame_done(slow.budget(), 50.0);
  for (int i = 0; i < 50; ++i) quick.frame_done(quick.budget(), 0.001);
  EXPECT_EQ(slow.budget(), 2'000u);
  EXPECT_EQ(quick.budget(), 1'000'000u);
}

TEST(Budget, FramesWithoutPointsChangeNothingWrong) {
  BudgetController controller(10.0, 500'000, {});
  for (int i = 0; i < 10; ++i) controller.frame_done(0, 1.0);
  EXPECT_EQ(controller.budget(), 500'000u);
}

}  // namespace
}  // namespace stipple::test::measure_budget
