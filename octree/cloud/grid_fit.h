// Steps and origins of grids that have to hold a given range in int32.
#pragma once

namespace stipple {

struct AxisRange {
  double min = 0.0;
  double max = 0.0;  // at least min; both finite
};

// Steps between the lowest and the highest int32, less one at each end for what rounding needs.
inline constexpr double kGridSteps = 4294967293.0;

// `scale` times the least of 1, 2, 5, 10, 20, ... at which `extent`, finite and 0 or more, takes at most kGridSteps.
double fitting_scale(double scale, double extent);

// `offset` where all of `range` fits into int32 from there; else moved by whole steps into the middle of the range.
double fitting_offset(double offset, double scale, const AxisRange& range);

}  // namespace stipple
