// hierarchy.bin from a list of nodes.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "octree/core/buffer.h"

namespace stipple::potree2 {

// Where a node with points is, in the tree and in octree.bin.
struct NodeEntry {
  std::uint64_t code = 0;  // Morton code, lowest of the cell
  std::uint64_t byte_offset = 0;
  std::uint64_t byte_size = 0;
  std::uint32_t points = 0;
  int level = 0;
};

struct HierarchyFile {
  Buffer<std::byte> bytes;
  std::uint64_t first_piece_bytes = 0;
  int depth = 0;            // level of the deepest node
  std::uint64_t nodes = 0;  // those without points between root and others included; proxies counted once
};

// Pieces of `step_size` levels, the root's first, each below those it continues. A leaf just below a piece is listed in
// it rather than in a piece of its own. A root without points for no nodes.
HierarchyFile write_hierarchy(std::vector<NodeEntry> nodes, int step_size);

}  // namespace stipple::potree2
