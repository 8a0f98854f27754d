// Whether the points of one node are where and what they should be.
#pragma once

#include <optional>
#include <string>

#include "octree/cloud/source.h"
#include "octree/store/tree_store.h"

namespace stipple {

// Each returns what is wrong with the first offending point, in a sentence; nothing when all is well.

// Each point in the node's cell, give or take TreeInfo::cell_margin.
std::optional<std::string> check_cell(const TreeInfo& info, const StoredNode& node, const PointBatch& points);

// Each value within the range that the tree states for its attribute. `points` has a column an attribute.
std::optional<std::string> check_ranges(const TreeInfo& info, const PointBatch& points);

// Boxes that are tight around the points, clusters that cover them one after the other, and profiles that can be those
// of so many points: they never fall from level to level.
std::optional<std::string> check_details(const NodeDetails& details, const PointBatch& points);

}  // namespace stipple
