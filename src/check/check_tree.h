// Whether an octree on disk is what it says.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "octree/store/tree_store.h"

namespace stipple {

struct Defect {
  std::string node;  // "r042"; empty when it is the tree's
  std::string what;  // a sentence
};

struct LevelReport {
  std::uint64_t nodes = 0;
  std::uint64_t inner_nodes = 0;
  std::uint64_t points = 0;
  double spacing = 0.0;                                           // as the metadata say; 0: unknown
  double closest_pair = std::numeric_limits<double>::infinity();  // in any inner node, world units
};

struct TreeReport {
  std::uint64_t nodes = 0;
  std::uint64_t points = 0;         // that the nodes hold
  std::uint64_t point_bytes = 0;    // that hold them
  std::vector<LevelReport> levels;  // by level
  std::optional<Defect> defect;     // the first: of files, of the tree, then of the nodes, breadth first
};

// Reads the whole tree once, on all cores; keeps the hierarchy in memory and a node a core. Holds that
// - the nodes hold as many points as the metadata state;
// - each has its file, or their bytes cover the one file without gaps or overlaps;
// - the points can be read, and each is in its node's cell, give or take its margin;
// - values are within the ranges that the metadata state, and counted by their histograms;
// - details (TreeStore::read_details()), where there are any, belong to the tree and fit the points;
// - no two points of an inner node are closer than promised (TreeInfo::minimal_distance), where something is.
// Throws Error when the hierarchy cannot be read.
TreeReport check_tree(const TreeStore& store);

}  // namespace stipple
