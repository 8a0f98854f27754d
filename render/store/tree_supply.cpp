#include "render/store/tree_supply.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "octree/core/error.h"
#include "octree/select/density.h"
#include "octree/select/frustum.h"
#include "render/frame/view_frustum.h"

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

TreeSupply::TreeSupply(std::shared_ptr<const TreeStore> store, ColorMap colors)
    : store_(std::move(store)), colors_(std::move(colors)) {
  const TreeInfo& info = store_->info();
  if (const auto index = find_attribute(info.source.schema, colors_.attribute)) attributes_.push_back(*index);
  nodes_ = in_store_order(*store_, locate_all(*store_, read_whole_hierarchy(*store_)));
  std::uint64_t points = 0;
  for (const StoredNode& node : nodes_) {
    first_id_.push_back(static_cast<std::uint32_t>(points));
    points += node.points;
  }
  if (points >= kNoPoint)
    throw Error(fmt::format("{}: has {} points; ids of 32 bits tell {} apart", info.source.path, points, kNoPoint - 1));
  for (std::size_t i = 0; i < kThreads; ++i) threads_.emplace_back([this] { work(); });
}

TreeSupply::~TreeSupply() {
  {
    const std::lock_guard lock(mutex_);
    stop_ = true;
  }
  work_ready_.notify_all();
  for (std::thread& thread : threads_) thread.join();
}

std::vector<VisibleCluster> TreeSupply::visible(const View& view) {
  {
    const std::lock_guard lock(mutex_);
    ++view_;
    queue_.clear();
    arrivals_.clear();
    under_way_ = 0;
  }
  const Frustum frustum = frustum_of(view);
  std::vector<std::pair<double, std::uint32_t>> seen;  // distance, node
  for (std::uint32_t n = 0; n < nodes_.size(); ++n) {
    const WorldBox box = generous_cell(store_->info(), nodes_[n]);
    if (may_see(frustum, box)) seen.emplace_back(nearest_distance(view.eye, box), n);
  }
  std::ranges::sort(seen);
  visible_nodes_ = seen.size();
  parts_.clear();
  std::vector<VisibleCluster> clusters;
  for (const auto& [distance, node] : seen) append_clusters(node, view, frustum, clusters);
  return clusters;
}

void TreeSupply::append_clusters(std::uint32_t n, const View& view, const Frustum& frustum,
                                 std::vector<VisibleCluster>& clusters) {
  const TreeInfo& info = store_->info();
  const auto append = [&](std::uint32_t first, std::uint32_t count, double pixels) {
    clusters.push_back({static_cast<std::uint32_t>(parts_.size()), count, pixels});
    parts_.push_back({n, first});
  };
  const auto count = static_cast<std::uint32_t>(nodes_[n].points);
  if (!store_->reads_parts()) {
    append(0, count, count);  // to be read once, in one go
    return;
  }
  if (!info.has_details) {
    const WorldBox box = generous_cell(info, nodes_[n]);
    append(0, count, uniform_pixels(box, count, view.forward, nearest_pixel_size(view, box)));
    return;
  }
  const auto [known, is_new] = details_.try_emplace(n);
  if (is_new) known->second = store_->read_details(nodes_[n]);
  for (const Cluster& cluster : known->second.clusters) {
    const WorldBox box = world_box(info.source.grid, cluster.box);
    if (!may_see(frustum, box)) continue;
    append(cluster.first, cluster.count,
           estimated_pixels(cluster.profile, info.cube.edge, nearest_pixel_size(view, box)));
  }
}

void TreeSupply::request(std::uint32_t handle, std::uint32_t first, std::uint32_t count) {
  const std::uint32_t largest = store_->reads_parts() ? kLargestRequest : count;
  const std::lock_guard lock(mutex_);
  for (std::uint32_t at = 0; at < count; at += largest) {
    const Part& part = parts_[handle];
    queue_.push_back({{part.node, part.first + first + at}, std::min(largest, count - at), view_});
    ++under_way_;
  }
  work_ready_.notify_all();
}

std::vector<PointPiece> TreeSupply::collect(std::uint32_t most) {
  given_.clear();
  std::vector<PointPiece> pieces;
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, kPatience, [this] { return !arrivals_.empty() || failure_ || under_way_ == 0; });
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

std::uint64_t TreeSupply::bytes_read() const {
  const std::lock_guard lock(mutex_);
  return bytes_read_;
}

TreeSupply::Arrival TreeSupply::read(const Request& request) const {
  PointBatch batch;
  store_->read_part(nodes_[request.part.node], request.part.first, request.count, attributes_, batch);
  Arrival arrival;
  arrival.first_id = first_id_[request.part.node] + request.part.first;
  arrival.points.resize(batch.positions.size());
  pack_points(colors_, batch.positions, batch.columns.empty() ? nullptr : &batch.columns.front(), 0, arrival.points);
  return arrival;
}

void TreeSupply::work() {
  std::unique_lock lock(mutex_);
  while (true) {
    work_ready_.wait(lock, [this] { return stop_ || !queue_.empty(); });
    if (stop_) return;
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
    const StoredNode& node = nodes_[request.part.node];
    bytes_read_ += node.byte_size * request.count / node.points;
    if (request.view != view_) continue;
    --under_way_;
    if (failure)
      failure_ = failure;
    else
      arrivals_.push_back(std::move(arrival));
    arrived_.notify_one();
  }
}

}  // namespace stipple
