// Octrees on disk: hierarchy and points on demand.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"
#include "octree/cloud/source.h"
#include "octree/tree/octree.h"

namespace stipple {

struct TreeInfo {
  SourceInfo source;     // path, format, version, encoding, points as the metadata state them, grid, schema, bounds
  RootCube cube;         // of the root node
  double spacing = 0.0;  // of the root's points, world units; halves with every level. 0: unknown
};

// A node as the hierarchy describes it.
struct StoredNode {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  std::uint32_t parent = kNone;
  std::array<std::uint32_t, 8> children{kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};  // x<<2 | y<<1 | z
  int level = 0;
  glm::uvec3 cell{0};  // of 2^level cells along each axis
  std::uint64_t points = 0;
  std::uint64_t byte_offset = 0;  // of its points
  std::uint64_t byte_size = 0;
};

// An octree that stays on disk. All functions may be called from several threads at once; reads are positioned reads
// without a lock.
class TreeStore {
 public:
  virtual ~TreeStore() = default;
  TreeStore() = default;
  TreeStore(const TreeStore&) = delete;
  TreeStore& operator=(const TreeStore&) = delete;

  virtual const TreeInfo& info() const = 0;

  // The nodes of one piece of the hierarchy, parents before children; `parent` and `children` are indices into the same
  // vector. Nodes whose children are in another piece are named in `continued`.
  struct HierarchyPiece {
    std::vector<StoredNode> nodes;
    struct Continuation {
      std::uint32_t node = 0;      // of this piece; it is the first node of the next
      std::uint64_t piece = 0;     // where the next piece is: for read_hierarchy
      std::uint64_t piece_size = 0;
    };
    std::vector<Continuation> continued;
  };
  // The piece that starts with the root.
  virtual HierarchyPiece root_piece() const = 0;
  // The piece a continuation leads to. `parent`: that node as known so far (its level and cell). Throws Error when the
  // hierarchy breaks off or contradicts itself.
  virtual HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const = 0;

  // Positions and the attributes asked for (indices into info().source.schema) of one node, in stored order. Throws Error
  // when the data break off.
  virtual void read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const = 0;
};

// The whole hierarchy in memory, pieces joined, parents before children.
std::vector<StoredNode> read_whole_hierarchy(const TreeStore& store);

}  // namespace stipple
