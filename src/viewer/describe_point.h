// Everything a file knows of one point.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <utility>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/store/tree_store.h"

namespace stipple {

// Attribute names and values as text, scale and offset applied.
using PointValues = std::vector<std::pair<std::string, std::string>>;

// Point `id` of the source, counted from 0. Reads the source until the point has come. Throws Error when the source
// does, or has no such point.
PointValues describe_point(const PointSource& source, std::uint64_t id);

// The point of a tree on disk with this id (see first_id_of()) and position. Reads the nodes whose cells hold the
// position, no more. Throws Error when there is no such point.
PointValues describe_point(const TreeStore& tree, std::uint32_t id, const glm::ivec3& position);

// "r04, 1234 points": the node of an octree in memory that has the point with this id; empty where none has.
std::string node_of(const Octree& octree, std::uint32_t id);

// A world coordinate with the decimals that the grid has: "637012.24". Of grids without (thirds, say) the shortest text
// that gives the double back.
std::string exact_text(const Grid& grid, const glm::ivec3& position, int axis);

}  // namespace stipple
