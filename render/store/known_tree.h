// The part of a tree's hierarchy that views have come to.
#pragma once

#include <compare>
#include <cstdint>
#include <exception>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

#include "octree/select/frustum.h"
#include "octree/store/tree_store.h"

namespace stipple {

// The cell of a node, and what points may be outside it; where the hierarchy knows a box, that.
WorldBox generous_cell(const TreeInfo& info, const StoredNode& node);

// Begins with the first piece of the hierarchy and grows by lookups, which read from disk and may be run by any thread;
// all else is for one thread.
class KnownTree {
 public:
  enum class Knowledge {
    continued,  // another piece of the hierarchy begins with this node
    listed,     // the node is not located, or its details not read
    known,
  };
  struct Node {
    StoredNode stored;
    Knowledge knowledge = Knowledge::listed;
    bool asked = false;  // a lookup is to come back
    TreeStore::HierarchyPiece::Continuation where{};
  };
  // What is to be found out of a node, and what was.
  struct Lookup {
    std::uint32_t index;
    Node node;
    TreeStore::HierarchyPiece piece{};
    std::optional<NodeDetails> details{};
    std::exception_ptr failure{};
    int tries = 0;  // that failed so far
  };
  // A node in sight.
  struct Sight {
    double distance;  // world units
    std::uint32_t node;
    auto operator<=>(const Sight&) const = default;
  };
  // Both front to back.
  struct InSight {
    std::vector<Sight> known;
    std::vector<Sight> unknown;  // and not asked for
  };

  explicit KnownTree(std::shared_ptr<const TreeStore> store);

  bool empty() const { return nodes_.empty(); }
  const StoredNode& node(std::uint32_t index) const { return nodes_[index].stored; }
  // Of a known node, where the tree has any.
  const NodeDetails* details(std::uint32_t index) const;

  // The distance from the frustum's eye to the node's cell, if that may be seen.
  std::optional<double> distance_if_seen(const Frustum& frustum, std::uint32_t index) const;
  // What is in sight of these nodes and of all below them, as far as the hierarchy is known.
  InSight look(const Frustum& frustum, std::vector<std::uint32_t> roots) const;

  // A lookup of the node, which then counts as asked for until it is taken or forgotten.
  Lookup ask(std::uint32_t index);
  void forget(const Lookup& lookup) { nodes_[lookup.index].asked = false; }
  // Reads what is asked for, or keeps why that failed; then it may be run again. Any thread.
  void run(Lookup& lookup) const;
  // Learns from a lookup that was run; nothing from one that failed. A piece that was there before is a failure.
  void take(Lookup& lookup);

  // Pieces of the hierarchy that were taken after the first.
  std::uint64_t pieces() const { return pieces_; }

 private:
  void take_piece(std::uint32_t index, const TreeStore::HierarchyPiece& piece);

  std::shared_ptr<const TreeStore> store_;
  PiecesRead read_;
  std::vector<Node> nodes_;  // the root first
  std::unordered_map<std::uint32_t, NodeDetails> details_;
  std::uint64_t pieces_ = 0;
};

}  // namespace stipple
