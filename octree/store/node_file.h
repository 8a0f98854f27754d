// Files that hold the points of one node.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <string>

#include "octree/cloud/grid.h"
#include "octree/cloud/source.h"
#include "octree/read/input_file.h"

namespace stipple {

// From the grid of a node to that of its tree: exact where the corners of one lie on the other.
class GridChange {
 public:
  GridChange(const Grid& from, const Grid& to);

  // Throws Error, whose message is for a sentence that names the file, when a position is beyond int32.
  void apply(std::span<glm::ivec3> positions) const;

 private:
  glm::dvec3 factor_;  // tree steps a node step
  glm::dvec3 shift_;   // tree steps
};

// Opens the file of a node. Throws Error naming the file and `expected` ("the 12 points of node r0") when it is
// missing.
InputFile open_node_file(const std::string& path, const std::string& expected);

// No points, and the columns asked for (indices into `schema`) as empty.
void clear_batch(const Schema& schema, std::span<const std::size_t> attributes, PointBatch& batch);

// What looking at a LAS header is counted as.
inline constexpr std::uint64_t kLasHeaderBytes = 375;

// LAS or LAZ. A node of more points is refused: a few bytes could claim any number.
inline constexpr std::uint64_t kMaxLasNodePoints = std::uint64_t{1} << 26;

// What the header says. Throws Error as open_file() and open_node_file() do, and above kMaxLasNodePoints.
SourceInfo las_node_info(const std::string& path, const std::string& expected);

// All points in the file's order, positions on `grid`, the attributes asked for (indices into `schema`) as columns.
// Throws Error naming the file when it lacks one of the attributes or has it as another type, or as las_node_info().
void read_las_node(const std::string& path, const std::string& expected, const Schema& schema,
                   std::span<const std::size_t> attributes, const Grid& grid, PointBatch& batch);

}  // namespace stipple
