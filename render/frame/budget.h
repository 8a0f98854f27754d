// How many points a frame may draw.
#pragma once

#include <cstdint>

#include "render/frame/frame_cost.h"

namespace stipple {

// Steers the points streamed a frame to a frame-time target (T16, section 3.3). Pure: time comes in as an argument.
class BudgetController {
 public:
  struct Limits {
    std::uint32_t least = 1'000;
    std::uint32_t most = 4'000'000;
  };

  // Where to start from when nothing is known.
  static constexpr std::uint32_t kFirstBudget = 100'000;

  BudgetController(double target_ms, std::uint32_t first_budget, const Limits& limits);

  // From the next frame_done() on.
  void aim_at(double target_ms) { target_ms_ = target_ms; }
  // Points the next frame may draw: at most four times, at least a quarter of what the last one might.
  std::uint32_t budget() const { return budget_; }
  // What a frame with `points` streamed points took. The fewer of its budget they are, the less is learnt from it; from
  // a frame without points, nothing.
  void frame_done(std::uint64_t points, double milliseconds);
  // Frames have so many times the pixels from now on.
  void scale_pixels(double ratio);
  const FrameCost& cost() const { return cost_; }

 private:
  void steer();

  double target_ms_;
  Limits limits_;
  std::uint32_t budget_;
  FrameCost cost_;
};

}  // namespace stipple
