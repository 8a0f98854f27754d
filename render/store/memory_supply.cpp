#include "render/store/memory_supply.h"

#include <algorithm>

#include "octree/select/order.h"
#include "render/frame/view_frustum.h"

namespace stipple {

std::vector<VisibleCluster> MemorySupply::visible(const View& view) {
  requested_.clear();
  const Frustum frustum = frustum_of(view);
  const std::vector<VisibleNode> nodes = stipple::visible_nodes(octree_, frustum);
  visible_nodes_ = nodes.size();
  std::vector<VisibleCluster> clusters;
  for (const VisibleNode& visible : nodes) {
    const Node& node = octree_.nodes[visible.node];
    for (std::uint32_t c = node.first_cluster; c < node.first_cluster + node.cluster_count; ++c) {
      const Cluster& cluster = octree_.clusters[c];
      const WorldBox box = world_box(octree_.grid, cluster.box);
      if (!may_see(frustum, box)) continue;
      clusters.push_back({c, cluster.count, estimate(cluster, box, octree_.cube.edge, view), visible.distance,
                          splat_range(point_size_, view, box)});
    }
  }
  return clusters;
}

void MemorySupply::request(std::uint32_t handle, std::uint32_t first, std::uint32_t count, bool one_pixel) {
  const std::uint32_t slot = octree_.clusters[handle].first + first;
  requested_.push_back({.points = points_.points.data() + slot,
                        .ids = points_.ids.empty() ? nullptr : points_.ids.data() + slot,
                        .first_id = slot,
                        .count = count,
                        .one_pixel = one_pixel});
}

std::vector<PointPiece> MemorySupply::collect(std::uint32_t most) {
  std::vector<PointPiece> pieces;
  std::size_t taken = 0;
  for (; taken < requested_.size() && requested_[taken].count <= most; ++taken) {
    pieces.push_back(requested_[taken]);
    most -= requested_[taken].count;
    bytes_read_ += requested_[taken].count * (sizeof(PackedPoint) + sizeof(std::uint32_t));
  }
  requested_.erase(requested_.begin(), requested_.begin() + static_cast<std::ptrdiff_t>(taken));
  // A request for more than a frame holds is given in parts
  if (most > 0 && !requested_.empty()) {
    PointPiece& large = requested_.front();
    pieces.push_back(large);
    pieces.back().count = most;
    bytes_read_ += most * (sizeof(PackedPoint) + sizeof(std::uint32_t));
    large.points += most;
    if (large.ids) large.ids += most;
    large.first_id += most;
    large.count -= most;
  }
  return pieces;
}

}  // namespace stipple
