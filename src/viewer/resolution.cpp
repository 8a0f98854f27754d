#include "src/viewer/resolution.h"

namespace stipple {
namespace {

// Frames that have to agree: one late frame says nothing, and coming back too soon flickers.
constexpr int kSlowFrames = 2;
constexpr int kFastFrames = 15;
// Of the time a frame has, what pixels may take, and what they may take at the next finer step to go there.
constexpr double kMost = 0.75;
constexpr double kMostFiner = 0.6;

}  // namespace

void Resolution::frame_done(double pixels_ms, double target_ms) {
  const double finer = divisor_ - 1;
  slow_ = pixels_ms > kMost * target_ms ? slow_ + 1 : 0;
  fast_ = divisor_ > 1 && pixels_ms * (divisor_ * divisor_) / (finer * finer) < kMostFiner * target_ms ? fast_ + 1 : 0;
  if (slow_ >= kSlowFrames && divisor_ < kCoarsest) {
    ++divisor_;
    slow_ = 0;
  } else if (fast_ >= kFastFrames) {
    --divisor_;
    fast_ = 0;
  }
}

}  // namespace stipple
