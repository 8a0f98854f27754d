#include "octree/select/order.h"

#include <algorithm>
#include <tuple>

namespace stipple {

std::vector<VisibleNode> visible_nodes(const Octree& octree, const Frustum& frustum) {
  std::vector<VisibleNode> visible;
  std::vector<std::uint32_t> open;
  if (!octree.nodes.empty()) open.push_back(0);
  while (!open.empty()) {
    const std::uint32_t index = open.back();
    const Node& node = octree.nodes[index];
    open.pop_back();
    if (!may_see(frustum, world_box(octree.grid, node.subtree_box))) continue;
    for (const std::uint32_t child : node.children)
      if (child != Node::kNone) open.push_back(child);
    if (node.count == 0) continue;
    const WorldBox own = world_box(octree.grid, node.box);
    if (may_see(frustum, own)) visible.push_back({index, nearest_distance(frustum, own)});
  }
  std::sort(visible.begin(), visible.end(), [](const VisibleNode& a, const VisibleNode& b) {
    return std::tie(a.distance, a.node) < std::tie(b.distance, b.node);
  });
  return visible;
}

}  // namespace stipple
