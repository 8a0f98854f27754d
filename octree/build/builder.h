// Building the octree of a cloud in memory.
#pragma once

#include "octree/build/options.h"
#include "octree/build/positions.h"
#include "octree/cloud/grid.h"
#include "octree/tree/octree.h"

namespace stipple {

// The octree of all positions, which lie within `bounds`; ids are their indices. Empty for no positions. The same for
// the same input, options apart from chunk_points, on any number of threads. On all cores; takes 32 to 45 bytes a point
// while working, beside the positions; 4 remain.
//
// A cell with no more than leaf_capacity points, or all of whose points have the same Morton code, becomes a leaf;
// the others keep the sample described in sampling.h. A node that would hold no point, nor any below it, is left out,
// so that a sparse node, its children all sampled away, may be a leaf of more than leaf_capacity points.
//
// Stages: code the points -> divide_into_chunks -> build_chunk_tree, independently -> join_chunk_trees. Throws Error
// for 2^32 - 1 or more positions, for a position outside `bounds` and for options of zero.
Octree build_octree(const Grid& grid, const GridBox& bounds, const PositionView& positions,
                    const BuildOptions& options = {});

}  // namespace stipple
