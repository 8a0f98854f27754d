// Dealing the points of a cluster to shards: boxes small enough to be behind what is drawn where the cluster is not.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/frame/point_set.h"

namespace stipple {

// A cluster's points lie in so many shards, neighbours each: the point at place k of the cluster is in shard
// k % kShards, so that any prefix of a cluster is a sample of all of its shards; and the first few shards are all over
// it, so that a shorter prefix is, too. docs/decisions/0011-hybrid.md
inline constexpr std::uint32_t kShards = 64;

// The box of a shard in 1024ths of its cluster's box, rounded outwards: the first cell that it touches and the last,
// ten bits an axis. 0 where the shard has no points.
struct ShardBox {
  static constexpr int kBits = 10;
  std::uint32_t first = 0;
  std::uint32_t last = 0;
};
using ShardBoxes = std::array<ShardBox, kShards>;

// Puts a shuffled cluster, the indices of whose points are given, in the order of its shards; those of a shard stay in
// the order they were in. `box` holds them all. Shards are as large as each other but for one point.
ShardBoxes deal_to_shards(const Grid& grid, std::span<std::uint32_t> cluster, std::span<const PackedPoint> points,
                          const GridBox& box);

}  // namespace stipple
