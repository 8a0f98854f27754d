// A whole cloud on the GPU by clusters of its octree.
#pragma once

#include <cstdint>
#include <vector>

#include "octree/tree/octree.h"
#include "render/frame/point_set.h"
#include "render/gpu/buffer.h"

namespace stipple {

// Points in store order, in chunks that any driver can address and that end where a cluster ends; beside them a table
// of the clusters, in the same order, for shaders/clusters.glsl.
class ClusterCloud {
 public:
  static constexpr std::uint32_t kPlaceBits = 22;  // of ClusterBox::place
  static constexpr std::uint32_t kChunkPoints = 1u << kPlaceBits;
  static constexpr std::uint32_t kMostChunks = 1024;  // what the other bits can tell apart
  static constexpr int kLevels = kMaxLevel + 1;

  struct Chunk {
    GpuBuffer points;  // PackedPoint
    GpuBuffer ids;     // uint32
  };
  // ClusterBox of shaders/clusters.glsl.
  struct ClusterBox {
    glm::ivec3 low;
    std::uint32_t place;
    glm::ivec3 high;
    std::uint32_t count;
  };

  // `points` in store order of the octree. Throws Error when memory is refused, or when shaders do not reach all
  // clusters.
  ClusterCloud(const PointSet& points, const Octree& octree);

  // Bytes of GPU memory that it takes.
  static std::uint64_t bytes_for(std::uint64_t points, std::uint64_t clusters);

  std::uint32_t clusters() const { return clusters_; }
  const std::vector<Chunk>& chunks() const { return chunks_; }
  const GpuBuffer& boxes() const { return boxes_; }
  // log2 of estimated_pixels() for pixels of root_edge() / 2^level, level 0 to kMaxLevel: kLevels floats a cluster.
  const GpuBuffer& log_pixels() const { return log_pixels_; }
  double root_edge() const { return root_edge_; }

 private:
  void append_chunk(const PointSet& points, std::size_t first, std::size_t end);

  std::uint32_t clusters_ = 0;
  double root_edge_;
  std::vector<Chunk> chunks_;
  GpuBuffer boxes_;
  GpuBuffer log_pixels_;
};

}  // namespace stipple
