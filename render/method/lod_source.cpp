#include "render/method/lod_source.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "octree/build/sampling.h"
#include "octree/core/error.h"
#include "octree/select/order.h"
#include "render/frame/view_frustum.h"

namespace stipple {

std::vector<LodSource::Part> MemoryLod::visible(const View& view) {
  std::vector<Part> parts;
  for (const VisibleNode& visible : visible_nodes(octree_, frustum_of(view))) {
    const Node& node = octree_.nodes[visible.node];
    const double spacing = std::ldexp(octree_.cube.edge, -node.level - kLatticeLevels);
    for (std::uint32_t c = node.first_cluster; c < node.first_cluster + node.cluster_count; ++c) {
      const Cluster& cluster = octree_.clusters[c];
      parts.push_back({cluster.first, cluster.count, spacing / std::max(visible.distance, view.near),
                       splat_range(point_size_, view, world_box(octree_.grid, cluster.box))});
    }
  }
  return parts;
}

bool MemoryLod::draw(std::span<const Part> parts, Selection& selection) {
  std::vector<Part> in_order(parts.begin(), parts.end());
  std::ranges::sort(in_order, {}, &Part::key);
  // Neighbours are drawn as one
  for (std::size_t i = 0; i < in_order.size();) {
    const std::size_t first = in_order[i].key;
    const bool pixels = one_pixel(in_order[i]);
    std::size_t end = first;
    for (; i < in_order.size() && in_order[i].key == end && one_pixel(in_order[i]) == pixels; ++i)
      end += in_order[i].count;
    cloud_.append_items(first, end - first, selection.items, pixels);
    selection.points += end - first;
  }
  return true;
}

TreeLod::TreeLod(std::shared_ptr<const TreeStore> store, const ColorMap& colors, std::uint64_t bytes_before,
                 std::uint32_t slots)
    : store_(store),
      supply_(store, colors, bytes_before),
      reader_(store, colors, store->info().cube.edge),
      pool_(slots, store->info().cube.edge) {}

std::vector<LodSource::Part> TreeLod::visible(const View& view) {
  for (const PartReader::Request& request : reader_.cancel()) loading_.erase(request.key);
  new_view_ = true;
  cannot_read_.clear();
  unread_ = {};
  return parts_of(supply_.visible(view));
}

std::vector<LodSource::Part> TreeLod::parts_of(const std::vector<VisibleCluster>& clusters) const {
  std::vector<Part> parts;
  for (const VisibleCluster& cluster : clusters) {
    const TreeSupply::Part& part = supply_.part(cluster.handle);
    parts.push_back({part_key(part.node, part.first), cluster.count,
                     supply_.projected_spacing(part.node, cluster.distance), cluster.splats});
  }
  return parts;
}

bool TreeLod::draw(std::span<const Part> parts, Selection& selection) {
  ++frame_;
  bool none_there = true;
  // First, so that none of them gives way to what arrives
  for (const Part& part : parts) {
    const auto resident = residents_.find(part.key);
    if (resident == residents_.end()) {
      request(part);
      continue;
    }
    resident->second.frame = frame_;
    none_there = false;
  }
  // A new view is shown as far as it is there: the camera may be moving
  receive(!std::exchange(new_view_, false) || none_there);
  bool all = true;
  for (const Part& part : parts) {
    const auto resident = residents_.find(part.key);
    if (resident == residents_.end()) {
      all = all && cannot_read_.contains(part.key);
      continue;
    }
    for (const ClusterRun& run : resident->second.runs) pool_.append_items(run, selection.items, one_pixel(part));
    selection.points += part.count;
  }
  return all;
}

void TreeLod::request(const Part& part) {
  if (!cannot_read_.contains(part.key) && loading_.insert(part.key).second)
    reader_.request({part.key, supply_.node(node_of(part.key)), first_of(part.key), part.count});
}

void TreeLod::receive(bool patient) {
  for (PartReader::Part& part : reader_.collect(patient)) {
    loading_.erase(part.request.key);
    if (!part.failure) {
      put(part);
    } else if (cannot_read_.insert(part.request.key).second) {
      unread_.add(part.failure);
    }
  }
}

Unread TreeLod::unread() const {
  Unread unread = supply_.unread();
  unread.add(unread_);
  return unread;
}

// What this frame draws has room; where nothing else gives way, the part came for an earlier one.
void TreeLod::put(PartReader::Part& part) {
  while (pool_.free_slots() < part.points.slots()) {
    const auto oldest = std::ranges::min_element(residents_, {}, [](const auto& entry) { return entry.second.frame; });
    if (oldest == residents_.end() || oldest->second.frame == frame_) return;
    pool_.free(oldest->second.runs);
    residents_.erase(oldest);
  }
  residents_[part.request.key] = {pool_.put(part.points, 0, part.points.slots()), frame_};
}

}  // namespace stipple
