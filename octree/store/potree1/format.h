// Potree 1.4 to 1.8 on disk, as PotreeConverter 1.x writes it: cloud.js, and in its octreeDir a file for every node.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "octree/cloud/grid.h"
#include "octree/store/json_value.h"
#include "octree/store/rows.h"
#include "octree/store/tree_store.h"

namespace stipple::potree1 {

// bin: rows of the attributes; positions are 3 x int32, times scale, from the corner of the node's cell.
// las, laz: files of that format.
enum class Encoding { bin, las, laz };

struct Metadata {
  int version_minor = 0;      // of 1.x: 4 to 8
  std::string octree_folder;  // beside cloud.js
  std::optional<std::uint64_t> points;
  WorldBox cube;   // boundingBox: the root node's cell
  WorldBox tight;  // tightBoundingBox; empty where there is none
  double spacing = 0.0;
  double scale = 0.0;
  Encoding encoding = Encoding::bin;
  RowLayout rows;                  // of bin nodes, less the position
  std::size_t position_place = 0;  // byte of a row
  // Levels a piece of the hierarchy; 0: all of it is in cloud.js, and nodes are not in folders (1.4).
  int step_size = 0;
  TreeStore::HierarchyPiece hierarchy;  // what cloud.js says of it
};

// cloud.js. Throws Error naming `path`, the key and what is expected there.
Metadata parse_metadata(const std::string& text, const std::string& path);

// Fills in rows and position_place from a list of attributes. Throws Error as above.
void parse_attributes(const JsonValue& json, Metadata& metadata);

// A piece of the hierarchy: `bytes` of the .hrc file `path`, 5 a node, little-endian, packed: child mask u8 (bit i:
// child x<<2|y<<1|z = i exists), points u32, breadth first. Nodes `step_size` levels below the first have a piece of
// their own if they have children. The numbers of points are not those of the files, by up to whatever the converter
// added later. Throws Error naming the byte when the piece breaks off or goes on after its last node.
inline constexpr std::size_t kRecordBytes = 5;
TreeStore::HierarchyPiece parse_piece(std::span<const std::byte> bytes, const StoredNode& first, int step_size,
                                      const std::string& path);

// Where the node's files are, beside cloud.js and without extension: "data/r04" (1.4), "data/r/02134/r021347" (1.5 on,
// here with a step of 5).
std::string place_of(const StoredNode& node, const Metadata& metadata);

// One grid for all nodes of a cube down to level `depth`. Corners of cells need not lie on multiples of `scale`: then
// it has up to 2^10 steps a `scale`, as many as it takes if the cube's edge is a multiple and the grid holds it, and
// else as leave a rounding of `scale` / 2^11.
Grid grid_of(const WorldBox& cube, double scale, int depth);

// The deepest level of the first piece of a hierarchy; where it goes on elsewhere, that of cells of 100 times `scale`.
int depth_for_grid(const TreeStore::HierarchyPiece& first, const WorldBox& cube, double scale);

}  // namespace stipple::potree1
