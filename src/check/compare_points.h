// Whether an octree holds exactly the points of its inputs.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/store/tree_source.h"
#include "src/check/check_tree.h"

namespace stipple {

struct Comparison {
  std::uint64_t input_points = 0;
  double largest_rounding = 0.0;            // that put an input's coordinate on the tree's grid, world units
  std::vector<std::string> compared;        // names of the attributes that the tree and any input have
  std::vector<std::string> in_tree_only;    // not compared
  std::vector<std::string> in_inputs_only;  // not compared
  std::optional<Defect> defect;             // one point that is not as often in the tree as in the inputs
};

// Compares positions and attributes as multisets, on the tree's grid and in its types, in any order. Reads all points
// once, and once more when they differ, to name one. Memory: about 100 KiB a core; for naming, what the 4096th part of
// the different points takes. Two 64-bit sums of hashes and a count stand for each part: a chance of 2^-128 to miss a
// difference that nobody has made on purpose.
Comparison compare_points(const TreeSource& tree, std::span<const std::unique_ptr<PointSource>> inputs);

}  // namespace stipple
