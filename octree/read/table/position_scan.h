// The grid for coordinates that come as floating point or decimal numbers.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "octree/cloud/grid.h"
#include "octree/cloud/grid_fit.h"

namespace stipple {

// What one axis needs. To get the same from the same file on any number of threads, scan fixed parts and merge them.
class AxisScan {
 public:
  // `values` are finite. `single`: the file has them as float, so that a place on a decimal grid is exact when it
  // rounds to the same float.
  void add(std::span<const double> values, bool single);
  void merge(const AxisScan& other);

  bool empty() const { return range_.min > range_.max; }
  const AxisRange& range() const { return range_; }
  // Least n for which all values are whole multiples of 2^-n or 10^-n, 0 or more; -1: there is none worth a grid.
  int binary_digits() const { return binary_; }
  int decimal_digits() const { return decimal_; }

 private:
  AxisRange range_{1.0, -1.0};
  int binary_ = 0;
  int decimal_ = 0;
};

struct ChosenGrid {
  Grid grid;
  // How far the nearest place on the grid can be from a value, world units; 0: every value is on it.
  double largest_rounding = 0.0;
};

// Exact where 32 bits suffice: a power of two when all values are multiples of it, else a power of ten when they are
// decimal numbers; else, for each axis, the finest power of two on which its range fits. Never coarser than 2^-12 of
// the cloud, as a step is also what the near plane keeps clear of.
ChosenGrid choose_grid(const std::array<AxisScan, 3>& axes);

}  // namespace stipple
