#include "render/frame/budget.h"

#include <algorithm>
#include <cmath>

namespace stipple {
namespace {

// A frame counts half as much as the next but one: found stable against noise of 10 % and settled after a doubling of
// the cost within 8 frames (tests/measure/budget.cpp holds both).
constexpr double kMemory = 0.7;
// Of the budgets, relative to their squared mean.
constexpr double kTellingVariance = 0.05;
// No step may change the budget by more: a single outlier must not.
constexpr double kLargestStep = 2.0;

}  // namespace

BudgetController::BudgetController(double target_ms, std::uint32_t first_budget, const Limits& limits)
    : target_ms_(target_ms), limits_(limits), budget_(std::clamp(first_budget, limits.least, limits.most)) {}

void BudgetController::frame_done(std::uint64_t points, double milliseconds) {
  const auto p = static_cast<double>(points);
  weight_ = kMemory * weight_ + 1.0;
  points_ = kMemory * points_ + p;
  ms_ = kMemory * ms_ + milliseconds;
  points2_ = kMemory * points2_ + p * p;
  points_ms_ = kMemory * points_ms_ + p * milliseconds;

  // Slope where the past budgets differ enough to tell it from noise, else as if all the time went to the points: that
  // is the steepest it can be, hence the most careful step
  const double mean_points = points_ / weight_;
  const double mean_ms = ms_ / weight_;
  const double variance = points2_ / weight_ - mean_points * mean_points;
  double per_point = mean_points > 0.0 ? mean_ms / mean_points : 0.0;
  if (variance > kTellingVariance * mean_points * mean_points) {
    const double slope = (points_ms_ / weight_ - mean_points * mean_ms) / variance;
    per_point = std::clamp(slope, 0.25 * per_point, per_point);
  }
  if (per_point <= 0.0) return;

  const double wanted = mean_points + (target_ms_ - mean_ms) / per_point;
  const double now = budget_;
  const double next = std::clamp(wanted, now / kLargestStep, now * kLargestStep);
  budget_ = static_cast<std::uint32_t>(
      std::clamp(next, static_cast<double>(limits_.least), static_cast<double>(limits_.most)));
}

}  // namespace stipple
