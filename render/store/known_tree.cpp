#include "render/store/known_tree.h"

#include <algorithm>
#include <utility>

#include "octree/core/error.h"

namespace stipple {

WorldBox generous_cell(const TreeInfo& info, const StoredNode& node) {
  if (node.box) return world_box(info.source.grid, *node.box);
  WorldBox box = cell_of(info.cube, node);
  box.min -= info.cell_margin;
  box.max += info.cell_margin;
  return box;
}

KnownTree::KnownTree(std::shared_ptr<const TreeStore> store) : store_(std::move(store)), read_(*store_) {
  const TreeStore::HierarchyPiece first = store_->root_piece();
  if (first.nodes.empty()) return;
  nodes_.push_back({first.nodes.front()});
  take_piece(0, first);
}

// The piece begins with node `index`.
void KnownTree::take_piece(std::uint32_t index, const TreeStore::HierarchyPiece& piece) {
  const auto base = static_cast<std::uint32_t>(nodes_.size());
  const auto index_here = [&](std::uint32_t node) {
    if (node == StoredNode::kNone) return node;
    return node == 0 ? index : base + node - 1;
  };
  for (std::size_t i = 0; i < piece.nodes.size(); ++i) {
    Node node{piece.nodes[i]};
    node.stored.parent = i == 0 ? nodes_[index].stored.parent : index_here(node.stored.parent);
    for (std::uint32_t& child : node.stored.children) child = index_here(child);
    if (!store_->must_locate()) node.knowledge = Knowledge::known;
    if (i == 0)
      nodes_[index] = node;
    else
      nodes_.push_back(node);
  }
  for (const auto& where : piece.continued) {
    nodes_[index_here(where.node)].knowledge = Knowledge::continued;
    nodes_[index_here(where.node)].where = where;
  }
}

const NodeDetails* KnownTree::details(std::uint32_t index) const {
  const auto found = details_.find(index);
  return found == details_.end() ? nullptr : &found->second;
}

std::optional<double> KnownTree::distance_if_seen(const Frustum& frustum, std::uint32_t index) const {
  const WorldBox box = generous_cell(store_->info(), nodes_[index].stored);
  if (!may_see(frustum, box)) return std::nullopt;
  return nearest_distance(frustum, box);
}

KnownTree::InSight KnownTree::look(const Frustum& frustum, std::vector<std::uint32_t> roots) const {
  InSight result;
  while (!roots.empty()) {
    const std::uint32_t index = roots.back();
    roots.pop_back();
    const auto distance = distance_if_seen(frustum, index);
    if (!distance) continue;
    const Node& node = nodes_[index];
    if (node.knowledge == Knowledge::known)
      result.known.push_back({*distance, index});
    else if (!node.asked)
      result.unknown.push_back({*distance, index});
    if (node.knowledge == Knowledge::continued) continue;
    for (const std::uint32_t child : node.stored.children)
      if (child != StoredNode::kNone) roots.push_back(child);
  }
  std::ranges::sort(result.known);
  std::ranges::sort(result.unknown);
  return result;
}

KnownTree::Lookup KnownTree::ask(std::uint32_t index) {
  nodes_[index].asked = true;
  return {index, nodes_[index]};
}

void KnownTree::run(Lookup& lookup) const {
  lookup.failure = nullptr;
  try {
    if (lookup.node.knowledge == Knowledge::continued) {
      lookup.piece = store_->read_piece(lookup.node.where, lookup.node.stored);
      return;
    }
    const StoredNode node = store_->locate(lookup.node.stored);
    if (node.points > 0 && store_->info().has_details) lookup.details = store_->read_details(node);
    lookup.node.stored = node;
  } catch (...) {
    lookup.failure = std::current_exception();
    ++lookup.tries;
  }
}

void KnownTree::take(Lookup& lookup) {
  Node& node = nodes_[lookup.index];
  node.asked = false;
  if (lookup.failure) return;
  if (lookup.node.knowledge == Knowledge::continued) {
    try {
      read_.add(lookup.node.where, lookup.node.stored);
    } catch (const Error&) {
      lookup.failure = std::current_exception();
      return;
    }
    ++pieces_;
    take_piece(lookup.index, lookup.piece);
    return;
  }
  node.stored = lookup.node.stored;
  node.knowledge = Knowledge::known;
  if (lookup.details) details_[lookup.index] = std::move(*lookup.details);
}

}  // namespace stipple
