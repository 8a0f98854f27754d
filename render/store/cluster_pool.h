// Room on the GPU for as many clusters as fit, allocated once, whose contents come and go.
#pragma once

#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "octree/core/buffer.h"
#include "render/frame/point_set.h"
#include "render/raster/rasterizer.h"
#include "render/store/cluster_table.h"

namespace stipple {

// Points cut into clusters, each in a slot of its own: slot s has points [s * kPoints, s * kPoints + rows[s].count);
// the last of them is repeated to its end, so that slots may be drawn whole.
struct SlottedPoints {
  static constexpr std::uint32_t kPoints = 256;  // of a slot: docs/decisions/0011-hybrid.md

  Buffer<PackedPoint> points;
  Buffer<std::uint32_t> ids;
  std::vector<ClusterTable::Row> rows;  // without `place`
  std::vector<float> log_pixels;        // ClusterTable::kLevels a slot
  std::vector<ShardBoxes> shards;       // of each slot

  std::uint32_t slots() const { return static_cast<std::uint32_t>(rows.size()); }
  // How many so many points take.
  static std::uint32_t slots_for(std::uint64_t points);
};

// Point i has id first_id + i. `root_edge`: see cut_clusters().
SlottedPoints slotted(const Grid& grid, std::span<const PackedPoint> points, std::uint32_t first_id, double root_edge);

// A slot of the pool is a cluster of the table; without points while it is free.
class ClusterPool {
 public:
  // Chunks are allocated when they are first used. At most ClusterTable::kMostClusters slots.
  ClusterPool(std::uint32_t slots, double root_edge);

  // Bytes of GPU memory that a slot takes.
  static constexpr std::uint64_t kSlotBytes =
      SlottedPoints::kPoints * (sizeof(PackedPoint) + sizeof(std::uint32_t)) + ClusterTable::kRowBytes;

  const ClusterTable& table() const { return table_; }
  std::uint32_t free_slots() const { return free_slots_; }

  // Copies slots [first, first + count) of `points`, as many as are free at least, into free slots; in as few runs as
  // can be. Throws Error when memory is refused.
  std::vector<ClusterRun> put(const SlottedPoints& points, std::uint32_t first, std::uint32_t count);
  void free(std::span<const ClusterRun> runs);

  // Appends the item that draws a run put() gave. `one_pixel`: see PointRange.
  void append_items(const ClusterRun& run, std::vector<DrawItem>& items, bool one_pixel) const;

 private:
  ClusterRun take(std::uint32_t count);
  void use_up_to(std::uint32_t slots);
  void write(const SlottedPoints& points, std::uint32_t from, const ClusterRun& run);

  ClusterTable table_;
  std::map<std::uint32_t, std::uint32_t> free_;  // first slot and number of the runs
  std::uint32_t free_slots_;
};

}  // namespace stipple
