// How many pixels a set of points can cover: what decides how many of them are worth drawing.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "octree/cloud/grid.h"
#include "octree/tree/octree.h"

namespace stipple {

// Which of the two below.
enum class DensityEstimate : std::uint8_t { box_count, uniform };

// From a box-count profile: the number of occupied cells as large as a pixel, which is `pixel_size` world units wide
// where the points are, less those that hide behind others. Between two levels it is interpolated in logarithms; pixels
// larger than the root cube or smaller than the finest cell give what those give.
//
// Hiding: when a pixel is halved, a cell fills at most four quarters of it, however many of its eight parts are
// occupied; cells that share the pixel fill quarters independently. For lines and surfaces, which grow by no more than
// four a level, this is the count of cells itself. tests/octree/density_test.cpp: within a factor of 3 of the pixels
// hit for lines and surfaces not seen end-on, of 6 for volumes, for which the count of cells alone is off without
// limit.
//
// `root_edge` and `pixel_size` above zero. Between 1 and the number of points; 0 for an empty profile.
double estimated_pixels(const BoxCounts& profile, double root_edge, double pixel_size);

// The estimate of earlier viewers (Tredinnick, Broecker, Ponto 2016): points spread evenly over their box cover its
// outline, seen along the unit vector `direction`, or one pixel each. Where they in fact stand
// close together it promises more pixels than there are: the weakness that the paper names, kept for comparison. At
// least 1 for a non-empty set.
double uniform_pixels(const WorldBox& box, std::size_t count, const glm::dvec3& direction, double pixel_size);

}  // namespace stipple
