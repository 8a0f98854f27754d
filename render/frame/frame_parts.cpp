#include "render/frame/frame_parts.h"

#include <algorithm>

namespace stipple {
namespace {

// What a part leaves to the others: of the time there is, and of the fixed part of their cost, whichever is more.
constexpr double kRest = 0.35;
constexpr double kRestOfFixed = 2.0;
// Of the time there is: what is more is no rest, and the part is the last.
constexpr double kMostRest = 0.5;
// Of the time there is, what the last part leaves.
constexpr double kLastRest = 0.05;
// Of the target, what is little.
constexpr double kLittle = 0.06;
// The load is one frame's, and never so far from the last one's.
constexpr double kMostLoad = 2.0;
// Of the points that a part may have by what the first parts cost, while nothing is known of others.
constexpr double kCautious = 0.5;

}  // namespace

FrameParts::FrameParts(double target_ms, std::uint32_t first_budget, const BudgetController::Limits& limits)
    : target_ms_(target_ms), limits_(limits), beginning_(target_ms, first_budget, limits) {}

std::uint32_t FrameParts::first(bool only) {
  only_ = only;
  drawn_ = 0;
  elapsed_ms_ = 0.0;
  load_ = 1.0;
  asked_ = beginning_.budget();
  return asked_;
}

std::uint32_t FrameParts::next(std::uint64_t points, double milliseconds) {
  const double took = milliseconds - elapsed_ms_;
  elapsed_ms_ = milliseconds;
  if (points == 0) return 0;
  const auto drawn = static_cast<double>(points);
  if (drawn_++ == 0) {
    const FrameCost& cost = beginning_.cost();
    if (cost.known()) load_ = std::clamp(took / cost.of(drawn), 1.0 / kMostLoad, kMostLoad);
    beginning_.aim_at(only_ ? target_ms_ : part_of(target_ms_));
    beginning_.frame_done(points, took);
  } else if (took > 0.0) {
    more_.learn(drawn, asked_, took);
  }
  // Who drew less than allowed has little to draw, or waits for a disk
  if (only_ || 2 * points < asked_) return 0;
  const double left = target_ms_ - milliseconds;
  asked_ = left < kLittle * target_ms_ ? 0 : points_in(part_of(left));
  if (asked_ == 0 && drawn_ == 1) more_.doubt_fixed_part();
  return asked_;
}

void FrameParts::scale_pixels(double ratio) {
  beginning_.scale_pixels(ratio);
  more_.scale_fixed_part(ratio);
}

double FrameParts::part_of(double milliseconds) const {
  const double rest = std::max(kRest * milliseconds, kRestOfFixed * load_ * more_.fixed());
  return rest > kMostRest * milliseconds ? (1.0 - kLastRest) * milliseconds : milliseconds - rest;
}

std::uint32_t FrameParts::points_in(double milliseconds) const {
  const FrameCost& first = beginning_.cost();
  if (!first.known()) return 0;
  const double points =
      more_.known() ? more_.points_in(milliseconds / load_) : kCautious * milliseconds / first.per_point();
  return points < limits_.least ? 0 : static_cast<std::uint32_t>(std::min<double>(points, limits_.most));
}

}  // namespace stipple
