// Clusters of points on the GPU, as the passes of shaders/clusters.glsl see them.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "octree/tree/octree.h"
#include "render/gpu/buffer.h"
#include "render/store/shards.h"

namespace stipple {

// Points lie in chunks that any driver can address, those of a cluster together and shuffled, so that any prefix is an
// even sample: see shards.h. A cluster is a row of each table.
struct ClusterTable {
  static constexpr std::uint32_t kPlaceBits = 22;  // of Row::place
  static constexpr std::uint32_t kChunkPoints = 1u << kPlaceBits;
  static constexpr std::uint32_t kMostChunks = 1024;  // what the other bits can tell apart
  static constexpr int kLevels = kMaxLevel + 1;
  // A chunk begins with a cluster whose number is a multiple of it; rows without points fill the gap.
  static constexpr std::uint32_t kBlock = 32;
  // Tables must not outgrow what shaders reach on Mesa's software renderer, 128 MiB.
  static constexpr std::uint32_t kMostClusters = 1'000'000;

  struct Chunk {
    GpuBuffer points;  // PackedPoint
    GpuBuffer ids;     // uint32
  };
  // ClusterBox of shaders/clusters.glsl.
  struct Row {
    glm::ivec3 low;  // tight, closed
    std::uint32_t place;
    glm::ivec3 high;
    std::uint32_t count;
  };

  // Room for `clusters` rows of every table; chunks are the caller's.
  void allocate(std::uint32_t clusters);
  // Rows from `first` on.
  void write_rows(std::uint32_t first, std::span<const Row> rows);
  void write_log_pixels(std::uint32_t first, std::span<const float> values);
  void write_shards(std::uint32_t first, std::span<const ShardBoxes> values);

  std::vector<Chunk> chunks;
  GpuBuffer boxes;  // a Row a cluster
  // log2 of estimated_pixels() for pixels of root_edge / 2^level, level 0 to kMaxLevel: kLevels floats a cluster.
  GpuBuffer log_pixels;
  GpuBuffer shards;            // ShardBoxes of each cluster; read as texels
  std::uint32_t size = 0;      // rows in use
  std::uint32_t capacity = 0;  // rows there is room for
  double root_edge = 1.0;      // world units

  // Bytes of GPU memory that a cluster takes beside its points.
  static constexpr std::uint64_t kRowBytes = sizeof(glm::ivec3) * 2 + 8 + kLevels * sizeof(float) + sizeof(ShardBoxes);
};
static_assert(sizeof(ClusterTable::Row) == 32);

// Consecutive clusters of a table.
struct ClusterRun {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

}  // namespace stipple
