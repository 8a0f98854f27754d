// A frame that is drawn in parts, to end when it should.
#pragma once

#include <cstdint>

#include "render/frame/budget.h"

namespace stipple {

// How long a frame takes, a machine that others use as well does not tell beforehand. So a part takes most of the time
// that is left, as far as can be foretold, and leaves the others enough to make up for what the foretelling missed. It
// ends where little is left, or less than another part would cost. Pure: time comes in as an argument.
//
//   std::uint64_t drawn = draw(parts.first());
//   while (const std::uint32_t points = parts.next(drawn, milliseconds)) drawn = draw_more(points);
class FrameParts {
 public:
  // `limits` hold for each part.
  FrameParts(double target_ms, std::uint32_t first_budget, const BudgetController::Limits& limits);

  // From the next frame on.
  void aim_at(double target_ms) { target_ms_ = target_ms; }
  // Points that the first part of the next frame may draw. `only`: nothing can be added to this frame, nor to those
  // after it, as far as is known; then next() always ends it, and they are steered as a BudgetController does.
  std::uint32_t first(bool only = false);
  // How many the last part drew, and what the frame has taken since it began: how many the next part may draw; 0: the
  // frame is at its end.
  std::uint32_t next(std::uint64_t points, double milliseconds);

  // Frames have so many times the pixels from now on.
  void scale_pixels(double ratio);
  // Of a frame's time, about what its pixels take, whatever its points; 0 while nothing is known.
  double fixed_ms() const { return beginning_.cost().fixed(); }

 private:
  // What the next part should take of what is left.
  double part_of(double milliseconds) const;
  std::uint32_t points_in(double milliseconds) const;

  double target_ms_;
  BudgetController::Limits limits_;
  BudgetController beginning_;  // first parts, which carry the last frame
  FrameCost more_;              // the others
  // Of this frame
  bool only_ = false;
  int drawn_ = 0;  // parts
  double elapsed_ms_ = 0.0;
  double load_ = 1.0;        // what its first part took, of what was expected
  std::uint32_t asked_ = 0;  // points of the last part
};

}  // namespace stipple
