// Octrees on disk: hierarchy and points on demand.
#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"
#include "octree/cloud/source.h"
#include "octree/tree/octree.h"

namespace stipple {

// What a tree says about the values of one attribute. Empty vectors, NaN: nothing.
struct AttributeRange {
  std::vector<double> min;  // a value a component, as stored times scale plus offset
  std::vector<double> max;
  std::vector<std::uint64_t> histogram;  // of attributes of one byte: 256 counts; else empty
};

struct TreeInfo {
  SourceInfo source;     // path, format, version, encoding, points as the metadata state them, grid, schema, bounds
  RootCube cube;         // of the root node
  double spacing = 0.0;  // of the root's points, world units; halves with every level. 0: unknown
  // No two points of an inner node are closer than this times the node's spacing. Empty: nothing is promised.
  std::optional<double> minimal_distance;
  // World units by which points may be outside their node's cell: formats round after the cell was chosen.
  glm::dvec3 cell_margin{0.0};
  bool has_details = false;   // see TreeStore::read_details()
  bool states_points = true;  // whether source.point_count comes from the metadata; else it is the sum over the nodes
  AttributeRange position_range;
  std::vector<AttributeRange> ranges;  // of each attribute of source.schema
  // Whether every node, and every piece of the hierarchy, has a file of its own, named after the node. Else there is
  // one for all, and byte offsets tell them apart.
  bool node_files = false;
  std::optional<std::uint64_t> point_bytes;      // of the file that holds the points, and nothing else, if there is one
  std::optional<std::uint64_t> hierarchy_bytes;  // of the file that holds the hierarchy, if there is one
};

// A node as the hierarchy describes it. Not all hierarchies know its points and bytes: see TreeStore::locate().
struct StoredNode {
  static constexpr std::uint32_t kNone = 0xFFFFFFFFu;

  std::uint32_t parent = kNone;
  std::array<std::uint32_t, 8> children{kNone, kNone, kNone, kNone, kNone, kNone, kNone, kNone};  // x<<2 | y<<1 | z
  int level = 0;
  glm::uvec3 cell{0};             // of 2^level cells along each axis
  std::uint64_t points = 0;       // what the hierarchy says; of a located node, what there is
  std::uint64_t byte_offset = 0;  // of its points, in their file
  std::uint64_t byte_size = 0;
  // Tight around all points of the node and of those below it, in trees whose cells are no octants; there the cell
  // says no more than the way from the root.
  std::optional<GridBox> box;

  bool is_leaf() const {
    for (const std::uint32_t child : children)
      if (child != kNone) return false;
    return true;
  }
};

// What is known of a node's points without reading them.
struct NodeDetails {
  GridBox box;  // tight
  BoxCounts profile;
  std::vector<Cluster> clusters;  // `first` counts from the node's first point
};

// The deepest level of a stored node, so that `cell` has room.
inline constexpr int kMaxStoredLevel = 31;

// "r" for the root, "r04" for child 4 of its child 0: what Potree calls a node.
std::string name_of(const StoredNode& node);

// The world box of the node's cell.
WorldBox cell_of(const RootCube& cube, const StoredNode& node);

// Child 0 to 7 of a node: level, cell and parent set.
StoredNode child_of(const StoredNode& node, std::uint32_t index, int child);

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
    struct Continuation {
      std::uint32_t node = 0;   // of this piece; it is the first node of the next
      std::uint64_t piece = 0;  // where in the hierarchy's file the next piece is; 0 + 0 where it has a file of its own
      std::uint64_t piece_size = 0;
    };
    std::vector<StoredNode> nodes;
    std::vector<Continuation> continued;  // these nodes have no byte range yet
  };
  // The piece that starts with the root. No nodes: the tree has no points.
  virtual HierarchyPiece root_piece() const = 0;
  // The piece a continuation leads to. `parent`: that node as known so far (its level and cell). Throws Error when the
  // hierarchy breaks off or contradicts itself.
  virtual HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const = 0;

  // The node as its points' file has it. Reads a header at most; a tree whose hierarchy knows it all returns `node`.
  // Throws Error when the file is missing or broken off, or contradicts a hierarchy that ought to know.
  virtual StoredNode locate(const StoredNode& node) const = 0;
  // Whether locate() or read_details() reads anything.
  bool must_locate() const { return info().node_files || info().has_details; }

  // Positions and the attributes asked for (indices into info().source.schema) of a located node, in stored order.
  // `batch.first` stays as it is. Throws Error when the data break off or contradict the node.
  virtual void read_points(const StoredNode& node, std::span<const std::size_t> attributes,
                           PointBatch& batch) const = 0;

  // Whether read_part() reads less than the node.
  virtual bool reads_parts() const = 0;
  // As read_points(), of points [first, first + count) of the node, which has as many.
  virtual void read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                         std::span<const std::size_t> attributes, PointBatch& batch) const;

  // Of a located node with points, if info().has_details: trees that are not ours know nothing. Throws Error when the
  // details break off or do not know the node.
  virtual NodeDetails read_details(const StoredNode& node) const;

  // From disk since the tree was opened, all included: metadata, hierarchy, headers, points.
  std::uint64_t bytes_read() const { return bytes_read_.load(std::memory_order_relaxed); }

 protected:
  void count_read(std::uint64_t bytes) const { bytes_read_.fetch_add(bytes, std::memory_order_relaxed); }

 private:
  mutable std::atomic<std::uint64_t> bytes_read_{0};
};

// The pieces of a hierarchy read so far. Disjoint pieces end where the file does; others would let a small file
// describe a tree without end.
class PiecesRead {
 public:
  explicit PiecesRead(const TreeStore& store);  // which has to live as long

  // Throws Error when the piece of `node` shares bytes with one that was added before.
  void add(const TreeStore::HierarchyPiece::Continuation& where, const StoredNode& node);

 private:
  const TreeStore& store_;
  std::map<std::uint64_t, std::uint64_t> ends_;  // first byte of the piece that ends there
};

// The whole hierarchy in memory, pieces joined, parents before children. Throws Error when pieces overlap.
std::vector<StoredNode> read_whole_hierarchy(const TreeStore& store);

// The nodes of a hierarchy, located on all cores. Throws the Error of the first, in their order, that cannot be.
std::vector<StoredNode> locate_all(const TreeStore& store, std::span<const StoredNode> hierarchy);

// The located nodes of a whole hierarchy that have points, in store order: that in which these stand in the file, or
// that of the hierarchy where every node has its own. Throws Error naming two nodes that share bytes, which would let a
// small file hold points without end.
std::vector<StoredNode> in_store_order(const TreeStore& store, std::span<const StoredNode> located);

// The located nodes with points of the uppermost level that has any: the root, but in trees that begin lower down.
// Reads no more of the hierarchy than it takes to find them.
std::vector<StoredNode> uppermost_nodes(const TreeStore& store);

}  // namespace stipple
