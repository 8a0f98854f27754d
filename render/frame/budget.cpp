#include "render/frame/budget.h"

#include <algorithm>

namespace stipple {
namespace {

constexpr double kLargestStep = 4.0;

}  // namespace

BudgetController::BudgetController(double target_ms, std::uint32_t first_budget, const Limits& limits)
    : target_ms_(target_ms), limits_(limits), budget_(std::clamp(first_budget, limits.least, limits.most)) {}

void BudgetController::frame_done(std::uint64_t points, double milliseconds) {
  if (points == 0 || milliseconds <= 0.0) return;
  cost_.learn(static_cast<double>(points), budget_, milliseconds);
  steer();
}

void BudgetController::scale_pixels(double ratio) {
  cost_.scale_fixed_part(ratio);
  if (cost_.known()) steer();
}

void BudgetController::steer() {
  const double now = budget_;
  const double next = std::clamp(cost_.points_in(target_ms_), now / kLargestStep, now * kLargestStep);
  budget_ = static_cast<std::uint32_t>(
      std::clamp(next, static_cast<double>(limits_.least), static_cast<double>(limits_.most)));
}

}  // namespace stipple
