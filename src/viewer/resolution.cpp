#include "src/viewer/resolution.h"

namespace stipple {
namespace {

// Frames that have to agree: one late frame says nothing, and coming back too soon flickers.
constexpr int kSlowFrames = 2;
constexpr int kFastFrames = 15;

}  // namespace

void Resolution::frame_done(double ms, bool least_points, double target_ms) {
  const double finer = divisor_ - 1;
  // What it would take at the next finer step, if all of it went by pixels
  const double at_finer = divisor_ > 1 ? ms * (divisor_ * divisor_) / (finer * finer) : ms;
  slow_ = least_points && ms > target_ms ? slow_ + 1 : 0;
  fast_ = divisor_ > 1 && at_finer < 0.9 * target_ms ? fast_ + 1 : 0;
  if (slow_ >= kSlowFrames && divisor_ < kCoarsest) {
    ++divisor_;
    slow_ = 0;
  } else if (fast_ >= kFastFrames) {
    --divisor_;
    fast_ = 0;
  }
}

}  // namespace stipple
