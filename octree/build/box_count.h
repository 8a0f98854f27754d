// Box-count profiles: how many cells a set occupies at each halving of the cell size.
#pragma once

#include <cstdint>
#include <span>

#include "octree/build/coded_point.h"
#include "octree/tree/octree.h"

namespace stipple {

// The profile of points in ascending order of code, in one pass: a cell begins at each point that differs from the one
// before in a digit of that level or of one above. All zero for no points.
BoxCounts box_counts(std::span<const CodedPoint> sorted);

}  // namespace stipple
