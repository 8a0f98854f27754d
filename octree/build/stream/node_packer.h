// A node's points made ready for the disk: clusters of neighbours, shuffled inside, boxes and profiles.
#pragma once

#include <cstdint>
#include <span>

#include "octree/build/stream/options.h"
#include "octree/build/stream/sampler.h"
#include "octree/store/potree2/writer.h"

namespace stipple {

struct CellId {
  int level = 0;
  std::uint64_t code = 0;  // lowest of the cell
};

// Reused from node to node; one a thread.
class NodePacker {
 public:
  NodePacker(const StreamOptions& options, std::size_t record_bytes)
      : cluster_points_(options.cluster_points), seed_(options.seed), record_bytes_(record_bytes) {}

  // Appends the node that holds points `own`, ascending indices; nothing for none.
  void pack(const SortedPoints& points, std::span<const std::uint32_t> own, const CellId& cell,
            potree2::PackedNodes& packed);

 private:
  Cluster pack_cluster(const SortedPoints& points, std::span<std::uint32_t> own, std::span<const CodedPoint> coded,
                       Buffer<std::byte>& bytes);

  std::size_t cluster_points_;
  std::uint64_t seed_;
  std::size_t record_bytes_;
  Buffer<CodedPoint> coded_;     // of the node
  Buffer<std::uint32_t> order_;  // indices, shuffled cluster by cluster
};

}  // namespace stipple
