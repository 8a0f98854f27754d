#include "octree/store/tree_store.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <exception>

#include "octree/core/error.h"

namespace stipple {
namespace {

using Piece = TreeStore::HierarchyPiece;

// Pieces that are known of and not read yet; `node` counts in the whole tree.
using Pending = std::deque<Piece::Continuation>;

// Appends a piece to the tree. Its first node takes the place of `root`, the node that led to it.
void append_piece(std::vector<StoredNode>& tree, std::uint32_t root, const Piece& piece, Pending& pending) {
  const auto base = static_cast<std::uint32_t>(tree.size());
  const auto index_in_tree = [&](std::uint32_t node) {
    if (node == StoredNode::kNone) return node;
    return node == 0 ? root : base + node - 1;
  };
  for (std::size_t i = 0; i < piece.nodes.size(); ++i) {
    StoredNode node = piece.nodes[i];
    node.parent = i == 0 ? tree[root].parent : index_in_tree(node.parent);
    for (std::uint32_t& child : node.children) child = index_in_tree(child);
    if (i == 0)
      tree[root] = node;
    else
      tree.push_back(node);
  }
  for (Piece::Continuation next : piece.continued) {
    next.node = index_in_tree(next.node);
    pending.push_back(next);
  }
}

}  // namespace

PiecesRead::PiecesRead(const TreeStore& store) : store_(store) {}

void PiecesRead::add(const Piece::Continuation& where, const StoredNode& node) {
  if (store_.info().node_files) return;  // a piece with a file of its own is its node's alone
  // A piece of no bytes is for the store to refuse
  const std::uint64_t end = where.piece + std::max<std::uint64_t>(where.piece_size, 1);
  const auto next = ends_.lower_bound(where.piece + 1);
  if (end < where.piece || (next != ends_.end() && next->second < end))
    throw file_error(store_.info().source.path, where.piece,
                     fmt::format("the hierarchy piece of node {} holds bytes of another piece; every node was "
                                 "expected once. The file is damaged; build or copy the tree again.",
                                 name_of(node)));
  ends_[end] = where.piece;
}

std::string name_of(const StoredNode& node) {
  std::string name = "r";
  for (int bit = node.level - 1; bit >= 0; --bit)
    name += static_cast<char>(
        '0' + ((node.cell.x >> bit & 1u) << 2 | (node.cell.y >> bit & 1u) << 1 | (node.cell.z >> bit & 1u)));
  return name;
}

WorldBox cell_of(const RootCube& cube, const StoredNode& node) {
  const double edge = std::ldexp(cube.edge, -node.level);
  const glm::dvec3 min = cube.min + edge * glm::dvec3(node.cell);
  return {min, min + edge};
}

StoredNode child_of(const StoredNode& node, std::uint32_t index, int child) {
  StoredNode result;
  result.parent = index;
  result.level = node.level + 1;
  result.cell = node.cell * 2u + glm::uvec3(child >> 2 & 1, child >> 1 & 1, child & 1);
  return result;
}

std::vector<StoredNode> read_whole_hierarchy(const TreeStore& store) {
  std::vector<StoredNode> tree;
  const Piece first = store.root_piece();
  if (first.nodes.empty()) return tree;
  tree.emplace_back();
  Pending pending;
  PiecesRead read(store);
  append_piece(tree, 0, first, pending);
  while (!pending.empty()) {
    const Piece::Continuation next = pending.front();
    pending.pop_front();
    read.add(next, tree[next.node]);
    append_piece(tree, next.node, store.read_piece(next, tree[next.node]), pending);
  }
  return tree;
}

std::vector<StoredNode> locate_all(const TreeStore& store, std::span<const StoredNode> hierarchy) {
  std::vector<StoredNode> nodes(hierarchy.size());
  std::vector<std::exception_ptr> failures(hierarchy.size());
  tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t i) {
    try {
      nodes[i] = store.locate(hierarchy[i]);
    } catch (const Error&) {
      failures[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
  return nodes;
}

std::vector<StoredNode> in_store_order(const TreeStore& store, std::span<const StoredNode> located) {
  std::vector<StoredNode> nodes;
  for (const StoredNode& node : located)
    if (node.byte_size > 0) nodes.push_back(node);
  if (store.info().node_files) return nodes;
  std::ranges::stable_sort(nodes, {}, &StoredNode::byte_offset);
  for (std::size_t i = 1; i < nodes.size(); ++i) {
    const StoredNode& before = nodes[i - 1];
    if (nodes[i].byte_offset - before.byte_offset < before.byte_size)
      throw Error(
          fmt::format("{}: node {} begins at byte {} of the points, inside node {}, which holds {} bytes from "
                      "byte {} on. The tree is damaged; build or copy it again.",
                      store.info().source.path, name_of(nodes[i]), nodes[i].byte_offset, name_of(before),
                      before.byte_size, before.byte_offset));
  }
  return nodes;
}

std::vector<StoredNode> uppermost_nodes(const TreeStore& store) {
  std::vector<StoredNode> found;
  std::deque<Piece> pieces{store.root_piece()};
  PiecesRead read(store);
  int level = kMaxStoredLevel;
  while (!pieces.empty()) {
    const Piece piece = std::move(pieces.front());
    pieces.pop_front();
    std::vector<bool> continued(piece.nodes.size());
    for (const Piece::Continuation& next : piece.continued) continued[next.node] = true;
    for (std::uint32_t i = 0; i < piece.nodes.size() && piece.nodes[i].level <= level; ++i) {
      if (continued[i]) continue;
      const StoredNode node = store.locate(piece.nodes[i]);
      if (node.points == 0) continue;
      if (node.level < level) found.clear();
      level = node.level;
      found.push_back(node);
    }
    for (const Piece::Continuation& next : piece.continued) {
      if (piece.nodes[next.node].level > level) continue;
      read.add(next, piece.nodes[next.node]);
      pieces.push_back(store.read_piece(next, piece.nodes[next.node]));
    }
  }
  return found;
}

void TreeStore::read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                          std::span<const std::size_t> attributes, PointBatch& batch) const {
  read_points(node, attributes, batch);
  const auto keep = [first, count](auto& values, std::size_t each) {
    values.erase(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(first * each));
    values.resize(count * each);
  };
  keep(batch.positions, 1);
  for (Column& column : batch.columns) keep(column.bytes, column.attribute.bytes());
}

NodeDetails TreeStore::read_details(const StoredNode& node) const {
  throw Error(fmt::format("{}: knows nothing of node {} beside its points.", info().source.path, name_of(node)));
}

}  // namespace stipple
