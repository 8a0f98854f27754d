#include "octree/store/potree2/writer.h"

#include "octree/core/output_file.h"

namespace stipple::potree2 {

TreeWriter::TreeWriter(const std::string& folder)
    : folder_(folder), points_(folder + "/octree.bin"), sidecar_(folder) {}

std::uint64_t TreeWriter::place(const PackedNodes& packed) {
  const std::uint64_t begin = end_;
  std::span<const Cluster> clusters = packed.clusters;
  for (const PackedNodes::PackedNode& node : packed.nodes) {
    nodes_.push_back({node.code, end_, node.bytes, node.points, node.level});
    sidecar_.add({end_, 0, node.points, node.clusters, static_cast<std::uint32_t>(node.level), node.box, node.profile},
                 clusters.first(node.clusters));
    clusters = clusters.subspan(node.clusters);
    end_ += node.bytes;
  }
  return begin;
}

void TreeWriter::write(std::uint64_t place, std::span<const std::byte> bytes) {
  points_.write_at(place, bytes);
  points_.start_sync(place, bytes.size());
}

void TreeWriter::finish(Metadata& metadata, SidecarHeader sidecar) {
  const HierarchyFile hierarchy = write_hierarchy(nodes_, metadata.step_size);
  metadata.first_piece_bytes = hierarchy.first_piece_bytes;
  metadata.depth = hierarchy.depth;
  sidecar.octree_bytes = end_;
  const std::string text = write_metadata(metadata);
  write_file(folder_ + "/hierarchy.bin", hierarchy.bytes);
  write_file(folder_ + "/metadata.json", text);
  bytes_written_ = end_ + hierarchy.bytes.size() + text.size() + sidecar_.finish(sidecar);
  points_.sync();
}

}  // namespace stipple::potree2
