#include "render/frame/budget.h"

#include <algorithm>
#include <cmath>

namespace stipple {
namespace {

// Standard deviations, relative to what a frame takes. Found by replaying recorded frames; results hardly differ within
// a factor of two of each.
constexpr double kLoad = 0.07;   // by which a frame's cost differs from the last one's, fixed and per point alike
constexpr double kSplit = 0.02;  // by which the fixed part and that per point each change by themselves
constexpr double kNoise = 0.05;  // of a frame, by chance
// A frame so many deviations from what was expected is a surprise.
constexpr double kSurprise = 2.0;
// Of the first frame's time: the fixed part, and how uncertain that is.
constexpr double kFirstFixed = 0.25;
// Of the time for points, what is left at least when the fixed part is corrected.
constexpr double kLeastSlope = 0.5;
constexpr double kLargestStep = 4.0;

}  // namespace

BudgetController::BudgetController(double target_ms, std::uint32_t first_budget, const Limits& limits)
    : target_ms_(target_ms), limits_(limits), budget_(std::clamp(first_budget, limits.least, limits.most)) {}

void BudgetController::frame_done(std::uint64_t points, double milliseconds) {
  if (points == 0 || milliseconds <= 0.0) return;
  const auto p = static_cast<double>(points);
  if (slope_ == 0.0)
    begin(p, milliseconds);
  else
    correct(p, milliseconds);

  const double now = budget_;
  const double next = std::clamp((target_ms_ - fixed_) / slope_, now / kLargestStep, now * kLargestStep);
  budget_ = static_cast<std::uint32_t>(
      std::clamp(next, static_cast<double>(limits_.least), static_cast<double>(limits_.most)));
}

void BudgetController::begin(double points, double milliseconds) {
  fixed_ = kFirstFixed * milliseconds;
  slope_ = (milliseconds - fixed_) / points;
  fixed2_ = fixed_ * fixed_;
  fixed_slope_ = -fixed2_ / points;
  slope2_ = fixed2_ / (points * points);
}

void BudgetController::correct(double points, double milliseconds) {
  // What has changed since the last frame
  const double expected = fixed_ + slope_ * points;
  const auto scale_both = [this](double variance) {
    fixed2_ += variance * fixed_ * fixed_;
    fixed_slope_ += variance * fixed_ * slope_;
    slope2_ += variance * slope_ * slope_;
  };
  scale_both(kLoad * kLoad);
  fixed2_ += kSplit * kSplit * expected * expected;
  slope2_ += kSplit * kSplit * slope_ * slope_;

  // A surprise counts in part; where the next frame repeats it, the load has changed
  const double noise = kNoise * expected * std::max(1.0, budget_ / points);
  const double known = fixed2_ + 2.0 * points * fixed_slope_ + points * points * slope2_;
  const double bound = kSurprise * std::sqrt(known + noise * noise);
  double error = milliseconds - expected;
  const int surprise = error > bound ? 1 : error < -bound ? -1 : 0;
  if (surprise != 0 && surprise == surprise_)
    scale_both(error * error / (expected * expected));
  else
    error = std::clamp(error, -bound, bound);
  surprise_ = surprise;

  const double with_fixed = fixed2_ + points * fixed_slope_;
  const double with_slope = fixed_slope_ + points * slope2_;
  const double variance = with_fixed + points * with_slope + noise * noise;
  const double fixed = fixed_ + with_fixed / variance * error;
  const double corrected = fixed + (slope_ + with_slope / variance * error) * points;
  fixed2_ -= with_fixed * with_fixed / variance;
  fixed_slope_ -= with_fixed * with_slope / variance;
  slope2_ -= with_slope * with_slope / variance;

  // Neither part is below nothing
  fixed_ = std::clamp(fixed, 0.0, std::max(0.0, corrected - kLeastSlope * slope_ * points));
  slope_ = (corrected - fixed_) / points;
}

}  // namespace stipple
