#include "render/method/hierarchical.h"

#include <algorithm>
#include <cmath>

#include "octree/select/density.h"
#include "octree/select/frustum.h"
#include "octree/select/order.h"

namespace stipple {
namespace {

// The least a cluster reads in a round: shorter stretches cost more to copy than to draw.
constexpr double kLeastRound = 16.0;
constexpr std::size_t kBytesPerPoint = sizeof(PackedPoint) + sizeof(std::uint32_t);

Frustum frustum_of(const View& view) {
  return make_frustum(view.eye, view.right, view.up, view.forward, std::atan(1.0 / view.cot_x),
                      std::atan(1.0 / view.cot_y));
}

}  // namespace

Hierarchical::Hierarchical(const PointSet& points, const Octree& octree, std::uint32_t largest_budget)
    : points_(points),
      octree_(octree),
      stream_(std::clamp(std::min(largest_budget, static_cast<std::uint32_t>(points.size())), 1u,
                         StreamBuffer::kLargestSection)) {}

void Hierarchical::start_view(const View& view) {
  const Frustum frustum = frustum_of(view);
  const std::vector<VisibleNode> nodes = visible_nodes(octree_, frustum, view.eye);
  counts_.nodes_visible = nodes.size();
  readings_.clear();
  next_ = 0;
  left_ = 0;
  for (const VisibleNode& visible : nodes) {
    const Node& node = octree_.nodes[visible.node];
    for (std::uint32_t c = node.first_cluster; c < node.first_cluster + node.cluster_count; ++c) {
      const Cluster& cluster = octree_.clusters[c];
      const WorldBox box = world_box(octree_.grid, cluster.box);
      if (!may_see(frustum, box)) continue;
      const double depth = std::max(nearest_depth(view.eye, view.forward, box), view.near);
      const double pixels = estimated_pixels(cluster.profile, octree_.cube.edge, view.pixel_size(depth));
      const auto allowed = static_cast<std::uint32_t>(std::ceil(std::max(pixels, kLeastRound)));
      readings_.push_back({cluster.first, cluster.count, 0, std::min(allowed, cluster.count)});
      left_ += cluster.count;
    }
  }
}

void Hierarchical::next_round() {
  std::erase_if(readings_, [](const Reading& reading) { return reading.taken == reading.count; });
  for (Reading& reading : readings_) reading.allowed = std::min(2 * reading.allowed, reading.count);
  next_ = 0;
}

Selection Hierarchical::select(std::uint32_t budget) {
  budget = std::min(budget, stream_.section_points());
  std::vector<PointSpan> spans;
  Selection selection;
  while (selection.points < budget && left_ > 0) {
    if (next_ == readings_.size()) next_round();
    Reading& reading = readings_[next_];
    const auto room = static_cast<std::uint32_t>(budget - selection.points);
    const std::uint32_t count = std::min(reading.allowed - reading.taken, room);
    if (count > 0) spans.push_back({reading.first + reading.taken, count});
    reading.taken += count;
    selection.points += count;
    left_ -= count;
    if (reading.taken == reading.allowed) ++next_;
  }
  if (selection.points == 0) return selection;
  selection.items.push_back(stream_.stream(points_, spans));
  counts_.bytes_read += selection.points * kBytesPerPoint;
  return selection;
}

}  // namespace stipple
