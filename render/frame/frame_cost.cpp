#include "render/frame/frame_cost.h"

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
constexpr double kLeastPerPoint = 0.5;
// Of the fixed part, what is believed of it after a doubt.
constexpr double kBelieved = 0.98;

}  // namespace

void FrameCost::learn(double points, double budget, double milliseconds) {
  if (known())
    correct(points, budget, milliseconds);
  else
    begin(points, milliseconds);
}

void FrameCost::doubt_fixed_part() {
  fixed_ms_ *= kBelieved;
}

void FrameCost::scale_fixed_part(double ratio) {
  fixed_ms_ *= ratio;
  fixed2_ *= ratio * ratio;
  fixed_per_point_ *= ratio;
}

void FrameCost::begin(double points, double milliseconds) {
  fixed_ms_ = kFirstFixed * milliseconds;
  per_point_ms_ = (milliseconds - fixed_ms_) / points;
  fixed2_ = fixed_ms_ * fixed_ms_;
  fixed_per_point_ = -fixed2_ / points;
  per_point2_ = fixed2_ / (points * points);
}

void FrameCost::correct(double points, double budget, double milliseconds) {
  // What has changed since the last frame
  const double expected = of(points);
  const auto scale_both = [this](double variance) {
    fixed2_ += variance * fixed_ms_ * fixed_ms_;
    fixed_per_point_ += variance * fixed_ms_ * per_point_ms_;
    per_point2_ += variance * per_point_ms_ * per_point_ms_;
  };
  scale_both(kLoad * kLoad);
  fixed2_ += kSplit * kSplit * expected * expected;
  per_point2_ += kSplit * kSplit * per_point_ms_ * per_point_ms_;

  // A surprise counts in part; where the next frame repeats it, the load has changed
  const double noise = kNoise * expected * std::max(1.0, budget / points);
  const double known = fixed2_ + 2.0 * points * fixed_per_point_ + points * points * per_point2_;
  const double bound = kSurprise * std::sqrt(known + noise * noise);
  double error = milliseconds - expected;
  const int surprise = error > bound ? 1 : error < -bound ? -1 : 0;
  if (surprise != 0 && surprise == surprise_)
    scale_both(error * error / (expected * expected));
  else
    error = std::clamp(error, -bound, bound);
  surprise_ = surprise;

  const double with_fixed = fixed2_ + points * fixed_per_point_;
  const double with_per_point = fixed_per_point_ + points * per_point2_;
  const double variance = with_fixed + points * with_per_point + noise * noise;
  const double fixed = fixed_ms_ + with_fixed / variance * error;
  const double corrected = fixed + (per_point_ms_ + with_per_point / variance * error) * points;
  fixed2_ -= with_fixed * with_fixed / variance;
  fixed_per_point_ -= with_fixed * with_per_point / variance;
  per_point2_ -= with_per_point * with_per_point / variance;

  // Neither part is below nothing
  fixed_ms_ = std::clamp(fixed, 0.0, std::max(0.0, corrected - kLeastPerPoint * per_point_ms_ * points));
  per_point_ms_ = (corrected - fixed_ms_) / points;
}

}  // namespace stipple
