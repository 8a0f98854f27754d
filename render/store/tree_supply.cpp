#include "render/store/tree_supply.h"

#include <algorithm>
#include <chrono>
#include <utility>

#include "octree/core/error.h"
#include "octree/select/density.h"
#include "render/frame/view_frustum.h"
#include "render/store/tree_ids.h"

namespace stipple {
namespace {

// Reads wait for the disk, not for a core.
constexpr std::size_t kThreads = 4;
// Points of one request: small enough that several threads share a node, large enough for the disk.
constexpr std::uint32_t kLargestRequest = 65536;
// How long collect() waits: a picture that stands still for a frame is better than a busy one.
constexpr std::chrono::milliseconds kPatience{20};

// The cell, and what points may be outside it.
WorldBox generous_cell(const TreeInfo& info, const StoredNode& node) {
  WorldBox box = cell_of(info.cube, node);
  box.min -= info.cell_margin;
  box.max += info.cell_margin;
  return box;
}

}  // namespace

TreeSupply::TreeSupply(std::shared_ptr<const TreeStore> store, ColorMap colors, std::uint64_t bytes_before)
    : store_(std::move(store)), colors_(std::move(colors)), bytes_before_(bytes_before) {
  if (const auto index = find_attribute(store_->info().source.schema, colors_.attribute)) attributes_.push_back(*index);
  const TreeStore::HierarchyPiece first = store_->root_piece();
  if (!first.nodes.empty()) {
    nodes_.push_back({first.nodes.front()});
    take_piece(0, first);
  }
  for (std::size_t i = 0; i < kThreads; ++i)
    threads_.emplace_back([this, looks_first = i % 2 == 0] { work(looks_first); });
}

TreeSupply::~TreeSupply() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  work_ready_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

// The piece begins with node `index`.
void TreeSupply::take_piece(std::uint32_t index, const TreeStore::HierarchyPiece& piece) {
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

std::optional<double> TreeSupply::distance_if_seen(std::uint32_t node) const {
  const WorldBox box = generous_cell(store_->info(), nodes_[node].stored);
  if (!may_see(frustum_, box)) return std::nullopt;
  return nearest_distance(view_.eye, box);
}

// What was asked for and not begun for the last view.
void TreeSupply::forget_queue() {
  const std::lock_guard lock(mutex_);
  ++view_number_;
  queue_.clear();
  arrivals_.clear();
  under_way_ = 0;
  looking_up_ -= lookups_.size();
  asked_ -= lookups_.size();
  for (const Lookup& lookup : lookups_) nodes_[lookup.index].asked = false;
  lookups_.clear();
}

std::vector<VisibleCluster> TreeSupply::visible(const View& view) {
  forget_queue();
  view_ = view;
  frustum_ = frustum_of(view);
  parts_.clear();
  visible_nodes_ = 0;
  if (nodes_.empty()) return {};
  return walk({0});
}

// The clusters of known nodes at and below `roots`, front to back; what is not known yet is asked for.
std::vector<VisibleCluster> TreeSupply::walk(std::vector<std::uint32_t> roots) {
  std::vector<Sight> seen, unknown;
  while (!roots.empty()) {
    const std::uint32_t index = roots.back();
    roots.pop_back();
    const auto distance = distance_if_seen(index);
    if (!distance) continue;
    const Node& node = nodes_[index];
    if (node.knowledge == Knowledge::known)
      seen.push_back({*distance, index});
    else if (!node.asked)
      unknown.push_back({*distance, index});
    if (node.knowledge == Knowledge::continued) continue;
    for (const std::uint32_t child : node.stored.children)
      if (child != StoredNode::kNone) roots.push_back(child);
  }
  std::ranges::sort(unknown);
  ask(unknown);
  std::ranges::sort(seen);
  std::vector<VisibleCluster> clusters;
  for (const Sight& sight : seen) append_clusters(sight, clusters);
  return clusters;
}

void TreeSupply::ask(const std::vector<Sight>& unknown) {
  if (unknown.empty()) return;
  const std::lock_guard lock(mutex_);
  for (const Sight& sight : unknown) {
    nodes_[sight.node].asked = true;
    lookups_.push_back({sight.node, nodes_[sight.node]});
  }
  asked_ += unknown.size();
  looking_up_ += unknown.size();
  work_ready_.notify_all();
}

std::vector<VisibleCluster> TreeSupply::discovered() {
  std::deque<Lookup> found;
  {
    const std::lock_guard lock(mutex_);
    found.swap(found_);
  }
  std::vector<std::uint32_t> roots;
  std::vector<Sight> seen;
  for (Lookup& lookup : found) {
    --asked_;
    nodes_[lookup.index].asked = false;
    const auto distance = distance_if_seen(lookup.index);
    if (lookup.failure) {
      // What the current view does not see may fail again when one does
      if (distance) std::rethrow_exception(lookup.failure);
    } else if (lookup.node.knowledge == Knowledge::continued) {
      ++pieces_read_;
      take_piece(lookup.index, lookup.piece);
      roots.push_back(lookup.index);
    } else {
      Node& node = nodes_[lookup.index];
      node.stored.points = lookup.node.stored.points;
      node.stored.byte_offset = lookup.node.stored.byte_offset;
      node.stored.byte_size = lookup.node.stored.byte_size;
      node.knowledge = Knowledge::known;
      if (lookup.details) details_[lookup.index] = std::move(*lookup.details);
      if (distance) seen.push_back({*distance, lookup.index});
    }
  }
  std::vector<VisibleCluster> clusters = walk(std::move(roots));
  std::ranges::sort(seen);
  for (const Sight& sight : seen) append_clusters(sight, clusters);
  std::ranges::stable_sort(clusters, {}, &VisibleCluster::distance);
  return clusters;
}

void TreeSupply::append_clusters(const Sight& sight, std::vector<VisibleCluster>& clusters) {
  const TreeInfo& info = store_->info();
  const StoredNode& node = nodes_[sight.node].stored;
  if (node.points == 0) return;
  ++visible_nodes_;
  first_id_of(node);  // throws when it has more points than a count of 32 bits holds
  const auto append = [&](std::uint32_t first, std::uint32_t count, double pixels) {
    clusters.push_back({static_cast<std::uint32_t>(parts_.size()), count, pixels, sight.distance});
    parts_.push_back({sight.node, first});
  };
  const auto count = static_cast<std::uint32_t>(node.points);
  if (!store_->reads_parts()) {
    append(0, count, count);  // to be read once, in one go
    return;
  }
  const auto details = details_.find(sight.node);
  if (details == details_.end()) {
    const WorldBox box = generous_cell(info, node);
    append(0, count, uniform_pixels(box, count, view_.forward, nearest_pixel_size(view_, box)));
    return;
  }
  for (const Cluster& cluster : details->second.clusters) {
    const WorldBox box = world_box(info.source.grid, cluster.box);
    if (!may_see(frustum_, box)) continue;
    append(cluster.first, cluster.count,
           estimated_pixels(cluster.profile, info.cube.edge, nearest_pixel_size(view_, box)));
  }
}

void TreeSupply::request(std::uint32_t handle, std::uint32_t first, std::uint32_t count) {
  const std::uint32_t largest = store_->reads_parts() ? kLargestRequest : count;
  const Part& part = parts_[handle];
  const std::lock_guard lock(mutex_);
  for (std::uint32_t at = 0; at < count; at += largest) {
    queue_.push_back({nodes_[part.node].stored, part.first + first + at, std::min(largest, count - at), view_number_});
    ++under_way_;
  }
  work_ready_.notify_all();
}

std::vector<PointPiece> TreeSupply::collect(std::uint32_t most) {
  given_.clear();
  std::vector<PointPiece> pieces;
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, kPatience, [this] {
    return !arrivals_.empty() || !found_.empty() || failure_ || (under_way_ == 0 && looking_up_ == 0);
  });
  if (failure_) std::rethrow_exception(failure_);
  while (most > 0 && !arrivals_.empty()) {
    Arrival& arrival = arrivals_.front();
    const std::uint32_t count = std::min(most, static_cast<std::uint32_t>(arrival.points.size()) - arrival.given);
    most -= count;
    // The part of an arrival that does not fit the frame stays for the next
    const bool all = arrival.given + count == arrival.points.size();
    given_.push_back(all ? std::move(arrival) : arrival);
    const Arrival& kept = given_.back();
    pieces.push_back({kept.points.data() + kept.given, nullptr, kept.first_id + kept.given, count});
    if (all)
      arrivals_.pop_front();
    else
      arrival.given += count;
  }
  return pieces;
}

TreeSupply::Arrival TreeSupply::read(const Request& request) const {
  PointBatch batch;
  store_->read_part(request.node, request.first, request.count, attributes_, batch);
  Arrival arrival;
  arrival.first_id = first_id_of(request.node) + request.first;
  arrival.points.resize(batch.positions.size());
  pack_points(colors_, batch.positions, batch.columns.empty() ? nullptr : &batch.columns.front(), 0, arrival.points);
  return arrival;
}

void TreeSupply::look_up(Lookup& lookup) const {
  StoredNode& node = lookup.node.stored;
  if (lookup.node.knowledge == Knowledge::continued) {
    lookup.piece = store_->read_piece(lookup.node.where, node);
    return;
  }
  node = store_->locate(node);
  if (node.points > 0 && store_->info().has_details) lookup.details = store_->read_details(node);
}

// Half of the threads look for what is in sight before they read points: neither keeps the other waiting.
void TreeSupply::work(bool looks_first) {
  std::unique_lock lock(mutex_);
  while (true) {
    work_ready_.wait(lock, [this] { return stop_ || !queue_.empty() || !lookups_.empty(); });
    if (stop_) return;
    if (!lookups_.empty() && (looks_first || queue_.empty()))
      do_lookup(lock);
    else
      do_request(lock);
  }
}

void TreeSupply::do_lookup(std::unique_lock<std::mutex>& lock) {
  Lookup lookup = std::move(lookups_.front());
  lookups_.pop_front();
  lock.unlock();
  try {
    look_up(lookup);
  } catch (...) {
    lookup.failure = std::current_exception();
  }
  lock.lock();
  --looking_up_;
  found_.push_back(std::move(lookup));
  arrived_.notify_one();
}

void TreeSupply::do_request(std::unique_lock<std::mutex>& lock) {
  const Request request = queue_.front();
  queue_.pop_front();
  lock.unlock();
  Arrival arrival;
  std::exception_ptr failure;
  try {
    arrival = read(request);
  } catch (...) {
    failure = std::current_exception();
  }
  lock.lock();
  if (request.view != view_number_) return;
  --under_way_;
  if (failure)
    failure_ = failure;
  else
    arrivals_.push_back(std::move(arrival));
  arrived_.notify_one();
}

}  // namespace stipple
