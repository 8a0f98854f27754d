#include "render/store/tree_supply.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "octree/core/error.h"
#include "octree/select/density.h"
#include "render/frame/view_frustum.h"
#include "render/store/disk_reads.h"
#include "render/store/tree_ids.h"

namespace stipple {
namespace {

// Points of one request: small enough that several threads share a node, large enough for the disk.
constexpr std::uint32_t kLargestRequest = 65536;

std::int32_t to_int32(double value) {
  return static_cast<std::int32_t>(std::clamp(value, -2147483648.0, 2147483647.0));
}

// The smallest box of the grid that holds the world's, and a cell more for what rounding does.
GridBox grid_box_around(const Grid& grid, const WorldBox& box) {
  const glm::dvec3 low = glm::floor(grid.grid_from_world(box.min)) - 1.0;
  const glm::dvec3 high = glm::ceil(grid.grid_from_world(box.max)) + 1.0;
  return {{to_int32(low.x), to_int32(low.y), to_int32(low.z)}, {to_int32(high.x), to_int32(high.y), to_int32(high.z)}};
}

}  // namespace

TreeSupply::TreeSupply(std::shared_ptr<const TreeStore> store, ColorMap colors, std::uint64_t bytes_before,
                       DensityEstimate density)
    : PointSupply(density),
      store_(std::move(store)),
      colors_(std::move(colors)),
      bytes_before_(bytes_before),
      tree_(store_) {
  attributes_ = attributes_of(colors_, store_->info().source.schema);
  for (std::size_t i = 0; i < kReadThreads; ++i)
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

// What was asked for and not begun for the last view.
void TreeSupply::forget_queue() {
  const std::lock_guard lock(mutex_);
  ++view_number_;
  queue_.clear();
  arrivals_.clear();
  under_way_ = 0;
  points_under_way_ = 0;
  unread_ = {};
  looking_up_ -= lookups_.size();
  asked_ -= lookups_.size();
  for (const KnownTree::Lookup& lookup : lookups_) tree_.forget(lookup);
  lookups_.clear();
}

std::vector<VisibleCluster> TreeSupply::visible(const View& view) {
  forget_queue();
  view_ = view;
  frustum_ = frustum_of(view);
  parts_.clear();
  visible_nodes_ = 0;
  if (tree_.empty()) return {};
  const KnownTree::InSight in_sight = tree_.look(frustum_, {0});
  ask(in_sight.unknown);
  std::vector<VisibleCluster> clusters;
  append_clusters(in_sight.known, clusters);
  return clusters;
}

void TreeSupply::ask(const std::vector<KnownTree::Sight>& unknown) {
  if (unknown.empty()) return;
  const std::lock_guard lock(mutex_);
  for (const KnownTree::Sight& sight : unknown) lookups_.push_back(tree_.ask(sight.node));
  asked_ += unknown.size();
  looking_up_ += unknown.size();
  work_ready_.notify_all();
}

std::vector<VisibleCluster> TreeSupply::discovered() {
  std::deque<KnownTree::Lookup> found;
  Unread unread;
  {
    const std::lock_guard lock(mutex_);
    found.swap(found_);
  }
  std::vector<std::uint32_t> continued;
  std::vector<KnownTree::Sight> seen;
  for (KnownTree::Lookup& lookup : found) {
    --asked_;
    tree_.take(lookup);
    const auto distance = tree_.distance_if_seen(frustum_, lookup.index);
    if (!distance) continue;  // of a failure, too, one that sees the node may learn: it will ask again
    if (lookup.failure)
      unread.add(lookup.failure);
    else if (lookup.node.knowledge == KnownTree::Knowledge::continued)
      continued.push_back(lookup.index);
    else
      seen.push_back({*distance, lookup.index});
  }
  if (unread.parts > 0) {
    const std::lock_guard lock(mutex_);
    unread_.add(unread);
  }
  const KnownTree::InSight below = tree_.look(frustum_, std::move(continued));
  ask(below.unknown);
  seen.insert(seen.end(), below.known.begin(), below.known.end());
  std::ranges::sort(seen);
  std::vector<VisibleCluster> clusters;
  append_clusters(seen, clusters);
  return clusters;
}

void TreeSupply::append_clusters(const std::vector<KnownTree::Sight>& seen, std::vector<VisibleCluster>& clusters) {
  for (const KnownTree::Sight& sight : seen) append_clusters(sight, clusters);
}

void TreeSupply::append_clusters(const KnownTree::Sight& sight, std::vector<VisibleCluster>& clusters) {
  const TreeInfo& info = store_->info();
  const StoredNode& node = tree_.node(sight.node);
  if (node.points == 0) return;
  ++visible_nodes_;
  first_id_of(node);  // throws when it has more points than a count of 32 bits holds
  const auto append = [&](std::uint32_t first, std::uint32_t count, const GridBox& box, double pixels) {
    clusters.push_back({static_cast<std::uint32_t>(parts_.size()), count, pixels, sight.distance,
                        splat_range(point_size_, view_, world_box(info.source.grid, box))});
    parts_.push_back({sight.node, first, box});
  };
  const auto count = static_cast<std::uint32_t>(node.points);
  const NodeDetails* details = tree_.details(sight.node);
  if (!details || !store_->reads_parts()) {
    const WorldBox box = generous_cell(info, node);
    // What can only be read in one go is read once
    const double pixels =
        store_->reads_parts() ? uniform_pixels(box, count, view_.forward, nearest_pixel_size(view_, box)) : count;
    append(0, count, details ? details->box : grid_box_around(info.source.grid, box), pixels);
    return;
  }
  for (const Cluster& cluster : details->clusters) {
    const WorldBox box = world_box(info.source.grid, cluster.box);
    if (!may_see(frustum_, box)) continue;
    append(cluster.first, cluster.count, cluster.box, estimate(cluster, box, info.cube.edge, view_));
  }
}

// Trees that do not say how far the root's points are apart are taken to have 128 along its edge, as Potree does.
double TreeSupply::projected_spacing(std::uint32_t node, double distance) const {
  const TreeInfo& info = store_->info();
  const double root_spacing = info.spacing > 0.0 ? info.spacing : info.cube.edge / 128.0;
  return std::ldexp(root_spacing, -tree_.node(node).level) / std::max(distance, view_.near);
}

void TreeSupply::request(std::uint32_t handle, std::uint32_t first, std::uint32_t count, bool one_pixel) {
  const std::uint32_t largest = store_->reads_parts() ? kLargestRequest : count;
  const Part& part = parts_[handle];
  const std::lock_guard lock(mutex_);
  for (std::uint32_t at = 0; at < count; at += largest) {
    queue_.push_back(
        {tree_.node(part.node), part.first + first + at, std::min(largest, count - at), one_pixel, view_number_});
    ++under_way_;
  }
  points_under_way_ += count;
  work_ready_.notify_all();
}

std::vector<PointPiece> TreeSupply::collect(std::uint32_t most) {
  given_.clear();
  std::vector<PointPiece> pieces;
  std::unique_lock lock(mutex_);
  arrived_.wait_for(lock, kReadPatience,
                    [this] { return !arrivals_.empty() || !found_.empty() || (under_way_ == 0 && looking_up_ == 0); });
  while (most > 0 && !arrivals_.empty()) {
    Arrival& arrival = arrivals_.front();
    const std::uint32_t count = std::min(most, static_cast<std::uint32_t>(arrival.points.size()) - arrival.given);
    most -= count;
    points_under_way_ -= count;
    // The part of an arrival that does not fit the frame stays for the next
    const bool all = arrival.given + count == arrival.points.size();
    given_.push_back(all ? std::move(arrival) : arrival);
    const Arrival& kept = given_.back();
    pieces.push_back({kept.points.data() + kept.given, nullptr, kept.first_id + kept.given, count, kept.one_pixel});
    if (all)
      arrivals_.pop_front();
    else
      arrival.given += count;
  }
  return pieces;
}

std::uint64_t TreeSupply::points_under_way() const {
  const std::lock_guard lock(mutex_);
  return points_under_way_;
}

Unread TreeSupply::unread() const {
  const std::lock_guard lock(mutex_);
  return unread_;
}

TreeSupply::Arrival TreeSupply::read(const Request& request) const {
  PointBatch batch;
  store_->read_part(request.node, request.first, request.count, attributes_, batch);
  Arrival arrival;
  arrival.first_id = first_id_of(request.node) + request.first;
  arrival.one_pixel = request.one_pixel;
  arrival.points.resize(batch.positions.size());
  pack_points(colors_, batch.positions, batch.columns, 0, arrival.points);
  return arrival;
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
  KnownTree::Lookup lookup = std::move(lookups_.front());
  lookups_.pop_front();
  lock.unlock();
  tree_.run(lookup);
  lock.lock();
  if (lookup.failure && lookup.tries < kReadTries) {
    lookups_.push_back(std::move(lookup));
    return;
  }
  --looking_up_;
  found_.push_back(std::move(lookup));
  arrived_.notify_one();
}

void TreeSupply::do_request(std::unique_lock<std::mutex>& lock) {
  Request request = queue_.front();
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
  if (failure && ++request.tries < kReadTries) {
    queue_.push_back(request);
    return;
  }
  --under_way_;
  if (failure) {
    unread_.add(failure);
    points_under_way_ -= request.count;
  } else {
    arrivals_.push_back(std::move(arrival));
  }
  arrived_.notify_one();
}

}  // namespace stipple
