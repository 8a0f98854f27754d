// Cutting points into clusters.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octree/core/buffer.h"
#include "octree/tree/octree.h"
#include "render/frame/point_set.h"
#include "render/store/shards.h"

namespace stipple {

struct ClusterCut {
  struct Piece {
    std::uint32_t first;  // of `order`
    std::uint32_t count;
    GridBox box;  // tight
  };
  Buffer<std::uint32_t> order;     // indices of the points
  std::vector<Piece> clusters;     // in order
  std::vector<ShardBoxes> shards;  // of each cluster
  std::vector<float> log_pixels;   // ClusterTable::kLevels a cluster, for pixels of root_edge / 2^level
};

// Clusters are stretches of at most `cluster_points` points of the Morton curve through all of them, each shuffled and
// dealt to shards. Takes kBytesPerPointOfOctree a point while it works, on all cores.
ClusterCut cut_clusters(const Grid& grid, const GridBox& bounds, std::span<const PackedPoint> points,
                        std::size_t cluster_points, double root_edge);

}  // namespace stipple
