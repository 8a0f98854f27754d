#include "octree/build/stream/node_packer.h"

#include <algorithm>
#include <utility>

#include "octree/build/box_count.h"
#include "octree/build/hash.h"
#include "octree/build/stream/record.h"

namespace stipple {

Cluster NodePacker::pack_cluster(const SortedPoints& points, std::span<std::uint32_t> own,
                                 std::span<const CodedPoint> coded, Buffer<std::byte>& bytes) {
  Cluster cluster;
  cluster.count = static_cast<std::uint32_t>(own.size());
  cluster.profile = box_counts(coded);
  for (const std::uint32_t i : own) cluster.box.extend(points.positions[i]);
  // Fisher-Yates; code and rank of the first point name the stream
  Random random(seed_, coded.front().code ^ (std::uint64_t{coded.front().rank} << 32));
  for (auto left = static_cast<std::uint32_t>(own.size()); left > 1; --left)
    std::swap(own[left - 1], own[random.below(left)]);
  const std::size_t end = bytes.size();
  bytes.resize(end + own.size() * record_bytes_);
  std::byte* to = bytes.data() + end;
  for (const std::uint32_t i : own) {
    copy_record(points.records + std::size_t{points.coded[i].id} * record_bytes_, record_bytes_, to);
    to += record_bytes_;
  }
  return cluster;
}

void NodePacker::pack(const SortedPoints& points, std::span<const std::uint32_t> own, const CellId& cell,
                      potree2::PackedNodes& packed) {
  if (own.empty()) return;
  order_.assign(own.begin(), own.end());
  coded_.resize(own.size());
  for (std::size_t i = 0; i < own.size(); ++i) coded_[i] = points.coded[own[i]];
  const std::size_t clusters = std::max<std::size_t>(1, (own.size() + cluster_points_ / 2) / cluster_points_);
  potree2::PackedNodes::PackedNode node{cell.level,
                                        cell.code,
                                        static_cast<std::uint32_t>(own.size()),
                                        static_cast<std::uint32_t>(clusters),
                                        own.size() * record_bytes_,
                                        {},
                                        box_counts(coded_)};
  for (std::size_t c = 0; c < clusters; ++c) {
    const std::size_t first = own.size() * c / clusters;
    const std::size_t count = own.size() * (c + 1) / clusters - first;
    Cluster cluster = pack_cluster(points, std::span(order_).subspan(first, count),
                                   std::span(coded_).subspan(first, count), packed.bytes);
    cluster.first = static_cast<std::uint32_t>(first);
    node.box.extend(cluster.box);
    packed.clusters.push_back(cluster);
  }
  packed.nodes.push_back(node);
}

}  // namespace stipple
