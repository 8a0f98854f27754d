// Stable ids for the points of trees on disk.
#pragma once

#include <cstdint>

#include "octree/store/tree_store.h"
#include "render/frame/point_set.h"

namespace stipple {

// The id of a located node's first point; the others follow. A hash of the node's place in the tree, so that no other
// node, nor any part of the hierarchy, has to be known. Two points share an id about as often as two random numbers of
// 32 bits are equal, which matters only if they are at one pixel and one depth: see docs/decisions/0008. Throws Error
// when a node has more points than there are ids.
std::uint32_t first_id_of(const StoredNode& node);

// The ids of all points of a tree in store order; `nodes` as in_store_order() gives them.
Buffer<std::uint32_t> ids_of(std::span<const StoredNode> nodes);

}  // namespace stipple
