// The octree: which points stand together, at which level, how dense they are. Structure only; the points stay with
// their owner, in store order.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>
#include <vector>

#include "octree/cloud/grid.h"
#include "octree/core/buffer.h"

namespace stipple {

// Halvings of the root cube that a Morton code of 63 bits can tell apart.
inline constexpr int kMaxLevel = 21;

// Box-count profile: occupied[level] is the number of cells of edge root_edge / 2^level that hold at least one of the
// points. Never falls with level, is at least 1 for a non-empty set and never above the number of points.
struct BoxCounts {
  std::array<std::uint32_t, kMaxLevel + 1> occupied{};
};

// The world cube that level 0 covers. Cells are half open: a point on a border belongs to the upper cell.
struct RootCube {
  glm::dvec3 min{0.0};
  double edge = 1.0;  // world units
};

// A few neighbouring points of one node, in shuffled order: any prefix is an even sample.
struct Cluster {
  std::uint32_t first = 0;  // slot in store order
  std::uint32_t count = 0;
  GridBox box;  // tight
  BoxCounts profile;
};

struct Node {
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  std::uint32_t parent = kNone;
  std::array<std::uint32_t, 8> children{kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};  // x<<2 | y<<1 | z
  int level = 0;
  glm::uvec3 cell{0};       // of 2^level cells along each axis
  std::uint32_t first = 0;  // slots [first, first + count) are the node's own points
  std::uint32_t count = 0;  // 0 for an inner node whose points all moved up
  std::uint32_t first_cluster = 0;
  std::uint32_t cluster_count = 0;
  GridBox box;          // tight, own points
  GridBox subtree_box;  // tight, own points and those of all descendants
  BoxCounts profile;    // own points

  bool is_leaf() const {
    for (const std::uint32_t child : children)
      if (child != kNone) return false;
    return true;
  }
};

// Additive: every point is in exactly one node. Inner nodes hold an even subsample of their subtree, leaves the rest.
struct Octree {
  Grid grid;
  GridBox bounds;  // that the cube was laid around: cells are counted from bounds.min
  RootCube cube;
  std::vector<Node> nodes;        // nodes[0] is the root; parents before children. Empty for an empty cloud
  std::vector<Cluster> clusters;  // a node's clusters are consecutive and cover its slots in order
  Buffer<std::uint32_t> order;    // order[slot] = stable id (index in the source)
};

}  // namespace stipple
