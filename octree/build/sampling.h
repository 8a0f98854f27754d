// Which points inner nodes hold.
//
// An inner node holds one point of each occupied cell of a lattice of 128^3 cells inside it. Every point has a random
// rank; a cell is represented by its point of lowest rank, which also represents every smaller cell around it. A point
// that represents cells of several lattices, one inside the other, goes to the topmost node.
//
// Guaranteed: the choice within a cell is uniform over all points of the cell; a node holds at most one point of a
// cell; a node and its ancestors together hold at least one of each occupied cell; the choice depends on the points and
// the seed alone, not on how they were divided for building. Not guaranteed: a smallest distance between points; two of
// them may touch across a border of cells. Blue-noise sampling, which does guarantee it, will come with the streaming
// builder.
#pragma once

#include <cstdint>
#include <span>

#include "octree/build/coded_point.h"

namespace stipple {

// Halvings of a node's edge to its lattice: 128 cells along an edge, as the spacing of Potree.
inline constexpr int kLatticeLevels = 7;

// A level below every leaf: the point stays in whatever leaf it falls in.
inline constexpr std::uint8_t kNotSampled = kMaxLevel + 1;

// level[i] = the topmost level at which an inner node holds sorted[i], or kNotSampled; one pass over points in
// ascending order. The points are all those of some cell. Answers above that cell are right among its points; whether
// its point of lowest rank (level[i] = 0) also represents a larger cell is for the caller to settle among such points.
void sample_levels(std::span<const CodedPoint> sorted, std::span<std::uint8_t> level);

}  // namespace stipple
