// What makes a kd tree of the files of a Potree 2.0 tree.
//
// kdtree.json stands in the place of metadata.json, with the same keys, so that nobody takes the folder for an
// octree. hierarchy.bin is one piece, in which children 0 and 1 are the lower and the upper part of a node; octree.bin
// and stipple.bin are as ever. boxes.bin has a box for each node, in the order of hierarchy.bin: min 3 x i32, max 3 x
// i32, little-endian, on the grid, both corners inside, tight around all points of the node and of those below it.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "octree/cloud/grid.h"
#include "octree/store/tree_store.h"

namespace stipple::potree2 {

inline constexpr const char* kKdMetadataName = "kdtree.json";
inline constexpr const char* kBoxesName = "boxes.bin";
inline constexpr std::size_t kBoxBytes = 24;

void write_boxes(const std::string& folder, std::span<const GridBox> boxes);

// Gives the nodes of the only piece their boxes; returns the bytes read. Throws Error when the file has not a box for
// each, or when a box is not within the one of its parent.
std::uint64_t read_boxes(const std::string& folder, std::vector<StoredNode>& nodes);

}  // namespace stipple::potree2
