#include "render/store/memory_supply.h"

#include <algorithm>

#include "octree/select/order.h"
#include "render/frame/view_frustum.h"

namespace stipple {

std::vector<VisibleCluster> MemorySupply::visible(const View& view) {
  requested_.clear();
  points_under_way_ = 0;
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
  requested_.push_back({octree_.clusters[handle].first + first, count, one_pixel});
  points_under_way_ += count;
}

PointPiece MemorySupply::piece(const Stretch& stretch) const {
  return {.points = points_->points.data() + stretch.first,
          .ids = points_->ids.empty() ? nullptr : points_->ids.data() + stretch.first,
          .first_id = stretch.first,
          .count = stretch.count,
          .one_pixel = stretch.one_pixel};
}

std::vector<PointPiece> MemorySupply::collect(std::uint32_t most) {
  std::vector<PointPiece> pieces;
  std::size_t taken = 0;
  const auto give = [&](const Stretch& stretch) {
    pieces.push_back(piece(stretch));
    most -= stretch.count;
    points_under_way_ -= stretch.count;
    bytes_read_ += stretch.count * (sizeof(PackedPoint) + sizeof(std::uint32_t));
  };
  for (; taken < requested_.size() && requested_[taken].count <= most; ++taken) give(requested_[taken]);
  requested_.erase(requested_.begin(), requested_.begin() + static_cast<std::ptrdiff_t>(taken));
  // A request for more than a frame holds is given in parts
  if (most > 0 && !requested_.empty()) {
    Stretch& large = requested_.front();
    const std::uint32_t part = most;
    give({large.first, part, large.one_pixel});
    large.first += part;
    large.count -= part;
  }
  return pieces;
}

}  // namespace stipple
