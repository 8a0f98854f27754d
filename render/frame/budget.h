// How many points a frame may draw.
#pragma once

#include <cstdint>

namespace stipple {

// Steers the points streamed a frame to a frame-time target (T16, section 3.3). A frame costs a fixed part (reproject,
// clear) and a part per point; both are followed by exponentially weighted least squares, so that the answer comes in a
// few frames and follows a scene that changes. Pure: time comes in as an argument.
class BudgetController {
 public:
  struct Limits {
    std::uint32_t least = 1'000;
    std::uint32_t most = 4'000'000;
  };

  // Where to start from when nothing is known.
  static constexpr std::uint32_t kFirstBudget = 100'000;

  BudgetController(double target_ms, std::uint32_t first_budget, const Limits& limits);

  // Points the next frame may draw.
  std::uint32_t budget() const { return budget_; }
  // What a frame with `points` streamed points took.
  void frame_done(std::uint64_t points, double milliseconds);

 private:
  double target_ms_;
  Limits limits_;
  std::uint32_t budget_;
  // Weighted sums over past frames of 1, points, ms, points^2, points * ms
  double weight_ = 0.0;
  double points_ = 0.0;
  double ms_ = 0.0;
  double points2_ = 0.0;
  double points_ms_ = 0.0;
};

}  // namespace stipple
