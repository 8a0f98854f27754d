// Joining the subtrees of chunks: the few levels above them, and one numbering for all.
#pragma once

#include <span>
#include <vector>

#include "octree/build/subtree.h"

namespace stipple {

// `chunks` in Morton order, together all points of the cloud; their subtrees and risen points are taken. Fills nodes,
// clusters and order of the result. Nodes stand in preorder, children by digit; nodes that hold no point and have no
// descendant with one are left out.
Octree join_chunk_trees(std::vector<ChunkTree>&& chunks, const PositionView& positions, const BuildOptions& options);

}  // namespace stipple
