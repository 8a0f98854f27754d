// A whole cloud on the GPU in clusters.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "octree/tree/octree.h"
#include "render/frame/point_set.h"
#include "render/gpu/buffer.h"

namespace stipple {

// Clusters are stretches of the Morton curve through all points, each shuffled, so that any prefix is an even sample.
// They are smaller and tighter than those of an octree's nodes, whose upper levels spread a sample over large cells:
// such boxes are hardly ever hidden (docs/decisions/0011-hybrid.md). The points lie in chunks that any driver can
// address and that end where a cluster ends; beside them is a table of the clusters for shaders/clusters.glsl.
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

  // Takes kBytesPerPointOfOctree a point in main memory while it works. Throws Error when memory is refused.
  explicit ClusterCloud(const PointSet& points);

  // About as many clusters are made of so many points.
  static std::uint64_t clusters_for(std::uint64_t points);
  // Bytes of GPU memory that they take.
  static std::uint64_t bytes_for(std::uint64_t points);

  std::uint32_t clusters() const { return clusters_; }
  const std::vector<Chunk>& chunks() const { return chunks_; }
  const GpuBuffer& boxes() const { return boxes_; }
  // log2 of estimated_pixels() for pixels of root_edge() / 2^level, level 0 to kMaxLevel: kLevels floats a cluster.
  const GpuBuffer& log_pixels() const { return log_pixels_; }
  double root_edge() const { return root_edge_; }

 private:
  void append_chunk(const PointSet& points, std::span<const std::uint32_t> order);
  void write_tables(const Octree& octree, std::span<const ClusterBox> boxes);

  std::uint32_t clusters_ = 0;
  double root_edge_ = 1.0;
  std::vector<Chunk> chunks_;
  GpuBuffer boxes_;
  GpuBuffer log_pixels_;
};

}  // namespace stipple
