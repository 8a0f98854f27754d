// Which nodes a view can see, in which order.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "octree/select/frustum.h"
#include "octree/tree/octree.h"

namespace stipple {

struct VisibleNode {
  std::uint32_t node = 0;
  double distance = 0.0;  // from the eye, the nearer of two, to the box of the node's own points, world units
};

// The nodes with points of their own whose box may be seen, front to back; at equal distance by number.
// Subtrees out of sight are left out whole.
std::vector<VisibleNode> visible_nodes(const Octree& octree, const Frustum& frustum);

}  // namespace stipple
