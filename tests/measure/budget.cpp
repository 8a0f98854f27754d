#include "render/frame/budget.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace stipple::test::measure_budget {
namespace {

// A machine that needs `fixed` ms a frame and `per_million` ms for a million points, both times `load`.
struct Machine {
  double fixed;
  double per_million;
  double load = 1.0;
  double frame(std::uint32_t points) const { return load * (fixed + per_million * points / 1e6); }
};

// Draws frames with the budget it gives, and says how long each took.
double draw(BudgetController& controller, const Machine& machine, double noise = 1.0) {
  const double ms = machine.frame(controller.budget()) * noise;
  controller.frame_done(controller.budget(), ms);
  return ms;
}

BudgetController settled(double target, const Machine& machine) {
  BudgetController controller(target, 100'000, {});
  for (int i = 0; i < 30; ++i) draw(controller, machine);
  return controller;
}

// Of `frames` frames after the first 20, the share within 10 % of the target. `load`: of each frame, noise included.
double share_near(double target, const Machine& machine, int frames, const std::function<double(int)>& load) {
  BudgetController controller(target, 100'000, {});
  int near = 0;
  for (int i = 0; i < 20 + frames; ++i) {
    const double ms = draw(controller, machine, load(i));
    if (i >= 20 && std::abs(ms - target) <= 0.1 * target) ++near;
  }
  return static_cast<double>(near) / frames;
}

TEST(Budget, ReachesTheTargetWithinTwelveFrames) {
  for (const double target : {16.0, 33.0, 66.0}) {
    const Machine machine{5.0, 40.0};
    BudgetController controller(target, 10'000, {});
    for (int i = 0; i < 12; ++i) controller.frame_done(controller.budget(), machine.frame(controller.budget()));
    EXPECT_NEAR(machine.frame(controller.budget()), target, 0.05 * target) << target;
  }
}

TEST(Budget, IsNearTheTargetThreeFramesAfterTheLoadDoubledOrHalved) {
  for (const double target : {33.0, 66.0})
    for (const double load : {2.0, 0.5}) {
      BudgetController controller = settled(target, {5, 40});
      for (int i = 0; i < 3; ++i) draw(controller, {5, 40, load});
      EXPECT_NEAR((Machine{5, 40, load}.frame(controller.budget())), target, 0.1 * target) << load;
    }
}

TEST(Budget, FollowsARampOfTheLoadWithoutLeavingTheTarget) {
  for (const double target : {33.0, 66.0}) {
    const auto ramp = [](int i) { return std::exp2(std::abs(i % 60 - 30) / 30.0); };
    EXPECT_EQ(share_near(target, {5, 40}, 300, ramp), 1.0);
  }
}

TEST(Budget, FollowsAFixedPartThatGrowsByItself) {
  BudgetController controller = settled(33.0, {5, 40});
  for (int i = 0; i < 100; ++i) EXPECT_NEAR(draw(controller, {5 + 0.2 * i, 40}), 33.0, 1.7) << i;
}

TEST(Budget, KeepsNineteenOfTwentyFramesNearTheTargetWhileTheLoadChanges) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(1.0, 0.03);
  for (const double target : {33.0, 66.0}) {
    const auto load = [&](int i) { return (i / 100 % 2 == 0 ? 1.0 : 2.0) * noise(random); };
    EXPECT_GE(share_near(target, {5, 40}, 1000, load), 0.95) << target;
  }
}

TEST(Budget, SteersWhereTheFixedPartLeavesLittle) {
  std::mt19937 random(1);
  std::normal_distribution<double> noise(1.0, 0.03);
  for (const double target : {33.0, 66.0})
    EXPECT_GE(share_near(target, {0.9 * target, 40}, 1000, [&](int) { return noise(random); }), 0.95) << target;
}

TEST(Budget, TakesASingleSlowFrameForChance) {
  BudgetController controller = settled(33.0, {5, 40});
  for (const double factor : {3.0, 10.0, 100.0}) {
    draw(controller, {5, 40}, factor);
    EXPECT_NEAR(draw(controller, {5, 40}), 33.0, 8.0) << factor;
    EXPECT_NEAR(draw(controller, {5, 40}), 33.0, 5.0) << factor;
    for (int i = 0; i < 10; ++i) draw(controller, {5, 40});
  }
}

TEST(Budget, ComesBackFromAFirstFrameThatIsSlow) {
  BudgetController controller(33.0, 100'000, {});
  draw(controller, {5, 40}, 50.0);
  for (int i = 0; i < 9; ++i) draw(controller, {5, 40});
  EXPECT_NEAR((Machine{5, 40}.frame(controller.budget())), 33.0, 3.3);
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

TEST(Budget, ComesBackFromATargetThatCouldNotBeReached) {
  BudgetController controller = settled(33.0, {20, 40, 2.0});
  EXPECT_EQ(controller.budget(), 1'000u);
  for (int i = 0; i < 8; ++i) draw(controller, {20, 40});
  EXPECT_NEAR((Machine{20, 40}.frame(controller.budget())), 33.0, 3.3);
}

TEST(Budget, FramesWithoutPointsChangeNothing) {
  BudgetController controller(10.0, 500'000, {});
  for (int i = 0; i < 10; ++i) controller.frame_done(0, 1.0);
  EXPECT_EQ(controller.budget(), 500'000u);

  BudgetController later = settled(33.0, {5, 40});
  const std::uint32_t before = later.budget();
  for (int i = 0; i < 10; ++i) later.frame_done(0, 0.01);
  EXPECT_EQ(later.budget(), before);
}

// What is left of a still view: no last frame to carry, hardly a point to draw.
TEST(Budget, FramesThatDrawLessThanTheyMightSayLittle) {
  BudgetController controller = settled(33.0, {5, 40});
  for (int i = 0; i < 100; ++i) controller.frame_done(500, 1.0);
  EXPECT_NEAR((Machine{5, 40}.frame(controller.budget())), 33.0, 10.0);
  for (int i = 0; i < 4; ++i) draw(controller, {5, 40});
  EXPECT_NEAR((Machine{5, 40}.frame(controller.budget())), 33.0, 3.3);
}

// The disk gives half of what a frame asks for.
TEST(Budget, IsTheSameWhetherFramesSpendAllOfItOrHalf) {
  BudgetController controller(33.0, 100'000, {});
  for (int i = 0; i < 50; ++i)
    controller.frame_done(controller.budget() / 2, Machine{5, 40}.frame(controller.budget() / 2));
  EXPECT_NEAR((Machine{5, 40}.frame(controller.budget())), 33.0, 3.3);
}

}  // namespace
}  // namespace stipple::test::measure_budget
