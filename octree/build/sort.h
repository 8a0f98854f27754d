// Sorting of points by Morton code.
#pragma once

#include <span>

#include "octree/build/coded_point.h"

namespace stipple {

// Sorts by operator< of CodedPoint in one thread. All codes agree in their digits up to `level`. `scratch` is as long
// as `points` and holds nothing of use afterwards. Radix sort from the top, three levels at a time, until a bucket is
// small enough to compare: fastest while points and scratch fit the cache.
void sort_points(std::span<CodedPoint> points, std::span<CodedPoint> scratch, int level);

}  // namespace stipple
