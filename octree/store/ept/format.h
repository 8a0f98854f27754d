// Entwine Point Tiles: ept.json, ept-hierarchy/D-X-Y-Z.json, ept-data/D-X-Y-Z.{laz,bin,zst}.
// Source: entwine.io/en/latest/entwine-point-tile.html, version 1.1.0; 0.0.0 is what Entwine 2 wrote before there was
// one.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"
#include "octree/store/rows.h"
#include "octree/store/tree_store.h"

namespace stipple::ept {

enum class DataType { laszip, binary, zstandard };

// A zstandard node that unpacks to more is refused: a few bytes could claim any size.
inline constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{512} << 20;

// X, Y or Z in a row: world = offset + scale * (stored).
struct Axis {
  std::size_t place = 0;  // byte of the row
  ScalarType type = ScalarType::i32;
  double scale = 1.0;
  double offset = 0.0;
  std::int64_t base = 0;  // of integers: the stored value that is 0 on the tree's grid

  bool is_real() const { return type == ScalarType::f32 || type == ScalarType::f64; }
};

struct Metadata {
  std::string version;
  DataType data_type = DataType::binary;
  std::uint64_t points = 0;
  WorldBox cube;
  WorldBox conforming;  // boundsConforming; empty where there is none
  double span = 0.0;    // cells of the root along an edge; 0: not stated
  // Of rows: the schema as it is packed in binary and zstandard nodes.
  std::array<Axis, 3> axes;
  RowLayout rows;
  std::vector<AttributeRange> ranges;  // of each of rows.fields
  Grid grid;                           // integers keep theirs; X, Y, Z of other types get one of 2^30 steps an edge
};

// ept.json. Throws Error naming `path`, the key and what is expected there.
Metadata parse_metadata(const std::string& text, const std::string& path);

// "2-0-3-1", which names the files of a node.
std::string key_of(const StoredNode& node);

// A page of the hierarchy: the JSON `text` of file `path` that begins with node `first`. A node whose descendants are
// listed and that is not listed itself has no points. Throws Error naming the key that is none of the page's.
TreeStore::HierarchyPiece parse_page(const std::string& text, const StoredNode& first, const std::string& path);

// Positions of all rows on the metadata's grid. Throws Error, whose message is for a sentence that names the file, when
// one does not fit.
void decode_positions(std::span<const std::byte> rows, const Metadata& metadata, Buffer<glm::ivec3>& positions);

}  // namespace stipple::ept
