// The binary tree of viewers that keep every point at every distance: split at the mean of the longest axis, until
// a node is small enough.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "octree/build/coded_point.h"
#include "octree/cloud/grid.h"

namespace stipple {

struct KdNode {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  int level = 0;
  std::uint32_t children = kNone;  // the lower child; the upper one follows it. kNone: a leaf
  std::size_t first = 0;           // its points and those below it: [first, first + count)
  std::size_t count = 0;
  GridBox box{};  // tight
};

// Nodes level by level, the root first. Orders `points`, whose ids are indices of `positions`, so that those of a node
// stand together. A node of no more than `leaf_capacity` points, or whose points are all in one place, or on level
// kMaxStoredLevel, is a leaf; others are split at the mean of the axis along which, in world units, they reach
// farthest: the lower child has what is not above. No node is empty; none at all for no points. All cores; the same on
// any number.
std::vector<KdNode> kd_partition(const Grid& grid, const PositionView& positions, std::span<CodedPoint> points,
                                 std::size_t leaf_capacity);

}  // namespace stipple
