// How many points a frame may draw.
#pragma once

#include <cstdint>

namespace stipple {

// Steers the points streamed a frame to a frame-time target (T16, section 3.3). A frame costs a fixed part (reproject,
// clear) and a part per point. A Kalman filter follows both: the load of the machine scales them together and changes
// from frame to frame, how they share a frame's time changes slowly. docs/decisions/0017-frame-time.md has what was
// measured. Pure: time comes in as an argument.
class BudgetController {
 public:
  struct Limits {
    std::uint32_t least = 1'000;
    std::uint32_t most = 4'000'000;
  };

  // Where to start from when nothing is known.
  static constexpr std::uint32_t kFirstBudget = 100'000;

  BudgetController(double target_ms, std::uint32_t first_budget, const Limits& limits);

  // Points the next frame may draw: at most four times, at least a quarter of what the last one might.
  std::uint32_t budget() const { return budget_; }
  // What a frame with `points` streamed points took. The fewer of its budget they are, the less is learnt from it; from
  // a frame without points, nothing.
  void frame_done(std::uint64_t points, double milliseconds);

 private:
  void begin(double points, double milliseconds);
  void correct(double points, double milliseconds);

  double target_ms_;
  Limits limits_;
  std::uint32_t budget_;
  double fixed_ = 0.0;  // ms
  double slope_ = 0.0;  // ms a point; 0: no frame yet
  // Their covariance
  double fixed2_ = 0.0;
  double fixed_slope_ = 0.0;
  double slope2_ = 0.0;
  int surprise_ = 0;  // 1, -1: the last frame took far more, far less than expected
};

}  // namespace stipple
