// The octree of one chunk: nodes, clusters and the order of their points, numbered from zero, ready to be joined.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "octree/build/chunks.h"
#include "octree/build/coded_point.h"
#include "octree/build/options.h"
#include "octree/core/buffer.h"
#include "octree/tree/octree.h"

namespace stipple {

// Part of an octree. Nodes stand in preorder, children by digit; `first`, `first_cluster` and `parent` count from the
// start of the part. Links to children and subtree boxes are made when parts are joined. Nodes may be without points.
struct Subtree {
  std::vector<Node> nodes;
  std::vector<Cluster> clusters;
  Buffer<std::uint32_t> order;  // ids
};

struct ChunkTree {
  Chunk chunk;
  Subtree tree;  // nodes[0] covers the chunk's cell

  // Points that nodes above the chunk hold, level after level, in ascending order of code on each.
  Buffer<CodedPoint> risen;
  std::array<std::uint32_t, kMaxLevel + 1>
      risen_end{};  // where the points of a level end; levels above the chunk's only
  // The chunk's point of lowest rank also rises, unless the chunk is the root. To which level is for the join to
  // settle: see sample_levels().
  CodedPoint lowest{};

  std::span<const CodedPoint> risen_to(int level) const {
    const std::uint32_t first = level == 0 ? 0 : risen_end[level - 1];
    return std::span(risen).subspan(first, risen_end[level] - first);
  }
};

// Makes `own`, in ascending order of code, the points of a new last node of the tree, which has level, cell and parent
// set: appends their clusters, and their ids, shuffled within each cluster. `positions` are indexed by id.
void append_node(Subtree& tree, Node node, std::span<const CodedPoint> own, const PositionView& positions,
                 const BuildOptions& options);

// `points` are those of `chunk`, in any order; they are sorted in place. One thread, recursion at most kMaxLevel deep.
ChunkTree build_chunk_tree(const Chunk& chunk, std::span<CodedPoint> points, const PositionView& positions,
                           const BuildOptions& options);

}  // namespace stipple
