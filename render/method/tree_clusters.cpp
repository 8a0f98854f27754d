#include "render/method/tree_clusters.h"

#include <algorithm>
#include <utility>

namespace stipple {
namespace {

// Slots freed at once: a share of the pool, so that it is not asked again in the next frame.
constexpr std::uint32_t kFreedShare = 16;
// Points uploaded in a frame, for each of its budget: what the next frames draw.
constexpr std::uint64_t kUploadShare = 2;
constexpr std::uint64_t kAheadShare = 4;
constexpr std::uint64_t kLeastPoints = 65'536;  // of a frame's uploads

}  // namespace

TreeClusters::TreeClusters(std::shared_ptr<const TreeStore> store, const ColorMap& colors, std::uint64_t bytes_before,
                           const Options& options)
    : store_(store),
      supply_(store, colors, bytes_before),
      reader_(store, colors, store->info().cube.edge, options.all_attributes),
      pool_(options.slots, store->info().cube.edge),
      points_ahead_(options.points_ahead) {}

void TreeClusters::count(SelectionCounts& counts) const {
  counts.bytes_read = supply_.bytes_read();
  counts.points_read = points_read_;
}

void TreeClusters::start_view(const View& view) {
  ++view_number_;
  for (const PartReader::Request& request : reader_.cancel()) loading_.erase(request.key);
  wanted_.clear();
  next_ = 0;
  unread_ = {};
  for (Arrival& arrival : arrivals_) arrival.uploaded = 0;
  want(supply_.visible(view));
}

void TreeClusters::want(const std::vector<VisibleCluster>& clusters) {
  for (const VisibleCluster& cluster : clusters) {
    const TreeSupply::Part& part = supply_.part(cluster.handle);
    const double urgency = supply_.projected_spacing(part.node, cluster.distance);
    const std::uint32_t step = store_->reads_parts() ? kLargestPart : cluster.count;
    for (std::uint32_t at = 0; at < cluster.count; at += step)
      want(part_key(part.node, part.first + at), part, std::min(step, cluster.count - at), urgency);
  }
  std::stable_sort(wanted_.begin() + static_cast<std::ptrdiff_t>(next_), wanted_.end(),
                   [](const Wanted& a, const Wanted& b) { return a.urgency > b.urgency; });
}

void TreeClusters::want(Key key, const TreeSupply::Part& part, std::uint32_t count, double urgency) {
  const auto resident = residents_.find(key);
  if (resident != residents_.end() && resident->second.whole) {
    resident->second.view = view_number_;
    resident->second.urgency = urgency;
    return;
  }
  const auto loading = loading_.find(key);
  if (loading != loading_.end())
    loading->second = urgency;
  else
    wanted_.push_back({key, urgency, count, part.box});
}

void TreeClusters::load(std::uint32_t budget, ClusterSelector& selector) {
  std::vector<Key> incomplete;
  for (const auto& [key, resident] : residents_)
    if (!resident.whole && resident.view != view_number_) incomplete.push_back(key);
  for (const Key key : incomplete) drop(key, selector);

  want(supply_.discovered());
  request(std::min(points_ahead_, std::max(kLeastPoints, kAheadShare * budget)), selector);
  receive(selector.open() == 0u && arrivals_.empty());
  upload(std::max(kLeastPoints, kUploadShare * budget), selector);
}

bool TreeClusters::finished() const {
  return next_ == wanted_.size() && loading_.empty() && !supply_.searching();
}

Unread TreeClusters::unread() const {
  Unread unread = supply_.unread();
  unread.add(unread_);
  return unread;
}

// Goes on in wanted_ until so many points are on their way, leaving out what is hidden.
void TreeClusters::request(std::uint64_t points, ClusterSelector& selector) {
  while (next_ < wanted_.size() && reader_.points_under_way() + arrived_points_ < points) {
    std::uint64_t asked = reader_.points_under_way() + arrived_points_;
    std::size_t end = next_;
    std::vector<GridBox> boxes;
    for (; end < wanted_.size() && asked < points; ++end) {
      asked += wanted_[end].count;
      boxes.push_back(wanted_[end].box);
    }
    const std::vector<bool> hidden = selector.sees_depth() ? selector.hidden(boxes) : std::vector<bool>(boxes.size());
    for (const bool is_hidden : hidden) {
      const Wanted& wanted = wanted_[next_++];
      if (is_hidden) continue;
      loading_[wanted.key] = wanted.urgency;
      reader_.request({wanted.key, supply_.node(node_of(wanted.key)), first_of(wanted.key), wanted.count});
    }
  }
}

void TreeClusters::receive(bool patient) {
  for (PartReader::Part& part : reader_.collect(patient)) {
    if (part.failure) {
      loading_.erase(part.request.key);
      unread_.add(part.failure);
      continue;
    }
    arrived_points_ += part.request.count;
    points_read_ += part.request.count;
    arrivals_.push_back({part.request.key, std::move(part.points), part.request.count});
  }
}

void TreeClusters::upload(std::uint64_t points, ClusterSelector& selector) {
  std::uint64_t uploaded = 0;
  while (!arrivals_.empty() && uploaded < points) {
    Arrival& arrival = arrivals_.front();
    const std::uint32_t left = arrival.points.slots() - arrival.uploaded;
    if (pool_.free_slots() < left) make_room(left, selector);
    // A part waits until all of it has room, unless it can never have
    const bool fits = arrival.points.slots() <= pool_.table().capacity;
    const std::uint32_t slots = std::min(left, pool_.free_slots());
    if (fits ? slots < left : slots == 0 && left > 0) return;
    Resident& resident = residents_[arrival.key];
    const std::vector<ClusterRun> runs = pool_.put(arrival.points, arrival.uploaded, slots);
    selector.add(runs);
    resident.runs.insert(resident.runs.end(), runs.begin(), runs.end());
    resident.view = view_number_;
    resident.urgency = loading_[arrival.key];
    resident.whole = fits;
    arrival.uploaded += slots;
    uploaded += std::uint64_t{slots} * SlottedPoints::kPoints;
    if (arrival.uploaded < arrival.points.slots()) continue;
    loading_.erase(arrival.key);
    arrived_points_ -= arrival.count;
    arrivals_.pop_front();
  }
}

// Frees slots until `slots` are free, and some more; fewer, if no more are to be had now.
void TreeClusters::make_room(std::uint32_t slots, ClusterSelector& selector) {
  const std::uint32_t wanted = std::max(slots, pool_.table().capacity / kFreedShare);
  const auto free_first = [&](std::vector<Key> keys, auto before) {
    std::ranges::sort(keys, [&](Key a, Key b) { return before(residents_.at(a), residents_.at(b)); });
    for (std::size_t i = 0; i < keys.size() && pool_.free_slots() < wanted; ++i) drop(keys[i], selector);
  };
  std::vector<Key> unseen;
  for (const auto& [key, resident] : residents_)
    if (resident.view != view_number_) unseen.push_back(key);
  free_first(std::move(unseen), [](const Resident& a, const Resident& b) { return a.view < b.view; });
  if (pool_.free_slots() >= slots || !selector.open()) return;
  free_first(finished_parts(selector), [](const Resident& a, const Resident& b) { return a.urgency < b.urgency; });
}

// Parts none of whose clusters has anything left for this view.
std::vector<TreeClusters::Key> TreeClusters::finished_parts(const ClusterSelector& selector) const {
  std::vector<bool> open(pool_.table().capacity);
  for (const std::uint32_t cluster : selector.open_clusters()) open[cluster] = true;
  std::vector<Key> finished;
  for (const auto& [key, resident] : residents_) {
    const bool has_open = std::ranges::any_of(resident.runs, [&](const ClusterRun& run) {
      const auto first = open.begin() + static_cast<std::ptrdiff_t>(run.first);
      return std::find(first, first + static_cast<std::ptrdiff_t>(run.count), true) != first + run.count;
    });
    if (!has_open) finished.push_back(key);
  }
  return finished;
}

void TreeClusters::drop(Key key, ClusterSelector& selector) {
  const std::vector<ClusterRun>& runs = residents_.at(key).runs;
  pool_.free(runs);
  selector.remove(runs);
  residents_.erase(key);
}

}  // namespace stipple
