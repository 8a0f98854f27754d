// Pieces of hierarchy.bin.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "octree/store/potree2/format.h"
#include "octree/store/tree_store.h"

namespace stipple::potree2 {

// What a node's byte range is held against.
struct PointFile {
  std::uint64_t bytes = 0;       // of octree.bin
  std::size_t record_bytes = 0;  // of a point in records
  Encoding encoding = Encoding::uncompressed;
};

// Reads the piece that `bytes` are, whose first byte is at `piece_offset` of the file `path`. `first` is its first node
// as known so far: parent, level and cell. Throws Error naming the node's byte in the file when the piece breaks off,
// goes on after its last node, is deeper than kMaxStoredLevel, or when a byte range does not fit.
TreeStore::HierarchyPiece read_piece(std::span<const std::byte> bytes, std::uint64_t piece_offset,
                                     const StoredNode& first, const PointFile& points, const std::string& path);

}  // namespace stipple::potree2
