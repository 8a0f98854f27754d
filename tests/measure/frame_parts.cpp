#include "render/frame/frame_parts.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <random>

namespace stipple::test::measure_frame_parts {
namespace {

// Milliseconds: of a frame's first part, of another, and of a million points.
struct Machine {
  double fixed = 8.0;
  double more_fixed = 2.0;
  double per_million = 40.0;
};

struct Frame {
  double ms = 0.0;
  int parts = 0;
  std::uint64_t points = 0;
};

// `load`: of each of its parts. `only`: nothing can be added to it.
Frame draw(
    FrameParts& parts, const Machine& machine, const std::function<double()>& load = [] { return 1.0; },
    bool only = false) {
  Frame frame;
  std::uint32_t points = parts.first(only);
  do {
    const double fixed = frame.parts++ == 0 ? machine.fixed : machine.more_fixed;
    frame.ms += load() * (fixed + machine.per_million * points / 1e6);
    frame.points += points;
    points = parts.next(points, frame.ms);
  } while (points > 0);
  return frame;
}

// Of the frames after the first twenty, the share within 10 % of the target. `load`: of each part of a frame; called
// with true for the first.
double share_near(double target, const Machine& machine, const std::function<double(bool)>& load) {
  FrameParts parts(target, 100'000, {});
  constexpr int kFrames = 2000;
  int near = 0;
  for (int i = 0; i < 20 + kFrames; ++i) {
    bool first = true;
    const Frame frame = draw(parts, machine, [&] { return load(std::exchange(first, false)); });
    if (i >= 20 && std::abs(frame.ms - target) <= 0.1 * target) ++near;
  }
  return static_cast<double>(near) / kFrames;
}

TEST(FrameParts, FillAFrameOfASteadyMachine) {
  for (const double target : {20.0, 50.0, 100.0}) {
    FrameParts parts(target, 100'000, {});
    for (int i = 0; i < 10; ++i) draw(parts, {});
    for (int i = 0; i < 50; ++i) EXPECT_NEAR(draw(parts, {}).ms, 0.97 * target, 0.06 * target) << i;
  }
}

TEST(FrameParts, MakeUpForALoadThatDiffersFromFrameToFrame) {
  for (const double target : {33.0, 50.0, 100.0}) {
    std::mt19937 random(1);
    std::lognormal_distribution<double> of_frame(0.0, 0.2);
    double load = 1.0;
    EXPECT_GE(share_near(target, {}, [&](bool first) { return first ? load = of_frame(random) : load; }), 0.97)
        << target;
  }
}

TEST(FrameParts, MakeUpForALoadThatDiffersFromPartToPart) {
  for (const double target : {33.0, 50.0, 100.0}) {
    std::mt19937 random(1);
    std::lognormal_distribution<double> of_part(0.0, 0.15);
    EXPECT_GE(share_near(target, {}, [&](bool) { return of_part(random); }), 0.95) << target;
  }
}

// As in the two tests before, where one number has to do for a frame.
TEST(FrameParts, DoWhatASingleBudgetCannot) {
  std::mt19937 random(1);
  std::lognormal_distribution<double> of_frame(0.0, 0.2);
  BudgetController controller(50.0, 100'000, {});
  int near = 0;
  for (int i = 0; i < 1000; ++i) {
    const double ms = of_frame(random) * (8.0 + 40.0 * controller.budget() / 1e6);
    controller.frame_done(controller.budget(), ms);
    if (std::abs(ms - 50.0) <= 5.0) ++near;
  }
  EXPECT_LE(near, 600);
}

TEST(FrameParts, AreOneThatTakesTheWholeTimeWhereNothingCanBeAdded) {
  FrameParts parts(50.0, 100'000, {});
  const auto whole = [&] {
    return draw(
        parts, {}, [] { return 1.0; }, true);
  };
  for (int i = 0; i < 20; ++i) whole();
  const Frame frame = whole();
  EXPECT_EQ(frame.parts, 1);
  EXPECT_NEAR(frame.ms, 50.0, 1.0);
  // Another method goes on
  draw(parts, {});
  EXPECT_NEAR(draw(parts, {}).ms, 48.0, 3.0);
}

TEST(FrameParts, AreAsManyAsAreWorthTheirFixedPart) {
  // Others cost more than is ever left for them
  FrameParts dear(50.0, 100'000, {});
  int parts = 0;
  for (int i = 0; i < 50; ++i) parts = draw(dear, {8.0, 60.0, 40.0}).parts;
  EXPECT_EQ(parts, 1);
  EXPECT_NEAR(draw(dear, {8.0, 60.0, 40.0}).ms, 47.5, 5.0);
  // They have become cheap
  for (int i = 0; i < 150; ++i) parts = std::max(parts, draw(dear, {}).parts);
  EXPECT_GT(parts, 1);
}

TEST(FrameParts, KeepWhatTheyKnowWhenTheTargetChanges) {
  FrameParts parts(50.0, 100'000, {});
  for (int i = 0; i < 20; ++i) draw(parts, {});
  parts.aim_at(100.0);
  draw(parts, {});  // its first part is as before
  EXPECT_NEAR(draw(parts, {}).ms, 97.0, 6.0);
}

TEST(FrameParts, FollowAChangeOfPixelsAtOnce) {
  FrameParts parts(50.0, 100'000, {});
  const Machine fine{24.0, 2.0, 40.0};
  for (int i = 0; i < 60; ++i) {
    parts.aim_at(i % 2 ? 50.0 : 65.0);  // frames of one size do not tell their fixed part
    draw(parts, fine);
  }
  EXPECT_NEAR(parts.fixed_ms(), 24.0, 3.0);
  parts.scale_pixels(0.25);
  const Frame frame = draw(parts, {6.0, 0.5, 40.0});
  EXPECT_NEAR(frame.ms, 48.5, 3.0);
  EXPECT_GT(frame.points, 900'000u);
}

TEST(FrameParts, EndWithTheFirstWhereThatTakesTheWholeTime) {
  FrameParts parts(20.0, 100'000, {});
  for (int i = 0; i < 20; ++i) draw(parts, {30.0, 2.0, 40.0});
  const Frame frame = draw(parts, {30.0, 2.0, 40.0});
  EXPECT_EQ(frame.parts, 1);
  EXPECT_EQ(frame.points, 1'000u);
}

TEST(FrameParts, EndWhereThereIsLittleToDraw) {
  FrameParts parts(50.0, 100'000, {});
  draw(parts, {});
  const std::uint32_t asked = parts.first();
  EXPECT_EQ(parts.next(asked / 2 - 1, 5.0), 0u);
  parts.first();
  EXPECT_EQ(parts.next(0, 5.0), 0u);
}

TEST(FrameParts, KeepTheLimitsEachAndMayExceedThemTogether) {
  const BudgetController::Limits limits{2'000, 50'000};
  FrameParts parts(50.0, 100'000, limits);
  std::uint64_t most = 0;
  for (int i = 0; i < 30; ++i) {
    std::uint32_t points = parts.first();
    std::uint64_t all = 0;
    double ms = 8.0;
    while (points > 0) {
      EXPECT_GE(points, limits.least);
      EXPECT_LE(points, limits.most);
      all += points;
      ms += 2.0 + 40.0 * points / 1e6;
      points = parts.next(points, ms);
    }
    most = std::max(most, all);
  }
  EXPECT_GT(most, 3u * limits.most);
}

}  // namespace
}  // namespace stipple::test::measure_frame_parts
