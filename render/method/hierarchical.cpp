#include "render/method/hierarchical.h"

#include <algorithm>
#include <cmath>

namespace stipple {
namespace {

// The least a cluster reads in a round: shorter stretches cost more to copy than to draw.
constexpr double kLeastRound = 16.0;

}  // namespace

Hierarchical::Hierarchical(std::unique_ptr<PointSupply> supply, std::uint32_t largest_budget)
    : supply_(std::move(supply)), stream_(std::clamp(largest_budget, 1u, StreamBuffer::kLargestSection)) {}

void Hierarchical::set_point_size(const PointSize& point_size) {
  point_size_ = point_size;
  supply_->set_point_size(point_size);
}

SelectionCounts Hierarchical::counts() const {
  SelectionCounts counts = counts_;
  counts.nodes_visible = supply_->visible_nodes();
  counts.bytes_read = supply_->bytes_read();
  return counts;
}

void Hierarchical::start_view(const View& view) {
  counts_ = {};
  readings_.clear();
  done_.clear();
  next_ = 0;
  to_request_ = 0;
  append(supply_->visible(view));
}

void Hierarchical::append(const std::vector<VisibleCluster>& clusters) {
  for (const VisibleCluster& cluster : clusters) {
    const double allowed = std::clamp(std::ceil(cluster.pixels), kLeastRound, 1e9);
    readings_.push_back({cluster.handle, cluster.count, 0, std::min(static_cast<std::uint32_t>(allowed), cluster.count),
                         cluster.distance, point_size_.pixels == 1.0 && cluster.splats == SplatRange::far});
    if (point_size_.world > 0.0) count_splats(cluster.splats, counts_);
    counts_.pixels_estimated += cluster.pixels;
    to_request_ += cluster.count;
  }
}

// What a view finds late takes its place, front to back, among what this round has not come to yet.
void Hierarchical::take_discovered() {
  const auto known = static_cast<std::ptrdiff_t>(readings_.size());
  append(supply_->discovered());
  if (known == static_cast<std::ptrdiff_t>(readings_.size())) return;
  const auto first = readings_.begin() + std::min(known, static_cast<std::ptrdiff_t>(next_) + 1);
  std::inplace_merge(first, readings_.begin() + known, readings_.end(),
                     [](const Reading& a, const Reading& b) { return a.distance < b.distance; });
}

void Hierarchical::next_round() {
  std::erase_if(readings_, [this](const Reading& reading) {
    const bool done = reading.requested == reading.count;
    if (done) done_.push_back(reading.handle);
    return done;
  });
  for (Reading& reading : readings_)
    reading.allowed = reading.allowed < reading.count / 2 ? 2 * reading.allowed : reading.count;
  next_ = 0;
}

// Until so many are under way.
void Hierarchical::request_ahead(std::uint64_t points) {
  std::uint64_t under_way = supply_->points_under_way();
  while (under_way < points && to_request_ > 0) {
    if (next_ == readings_.size()) next_round();
    Reading& reading = readings_[next_];
    const auto count =
        static_cast<std::uint32_t>(std::min<std::uint64_t>(reading.allowed - reading.requested, points - under_way));
    if (count > 0) supply_->request(reading.handle, reading.requested, count, reading.one_pixel);
    reading.requested += count;
    under_way += count;
    to_request_ -= count;
    if (reading.requested == reading.allowed) ++next_;
  }
}

std::vector<SightedBox> Hierarchical::boxes() const {
  using State = SightedBox::State;
  std::vector<SightedBox> boxes;
  for (const Reading& reading : readings_) {
    const State state = reading.requested == reading.count ? State::complete
                        : reading.requested > 0            ? State::streamed
                                                           : State::waiting;
    boxes.push_back({supply_->box(reading.handle), state});
  }
  for (const std::uint32_t handle : done_) boxes.push_back({supply_->box(handle), State::complete});
  return boxes;
}

Selection Hierarchical::select(std::uint32_t budget) {
  budget = std::min(budget, stream_.section_points());
  Selection selection;
  if (budget == 0) return selection;
  take_discovered();
  request_ahead(supply_->read_ahead(budget));
  std::vector<PointPiece> pieces = supply_->collect(budget);
  // What takes less work to draw stands together
  const auto others =
      std::stable_partition(pieces.begin(), pieces.end(), [](const PointPiece& piece) { return piece.one_pixel; });
  std::uint32_t of_one_pixel = 0;
  for (auto piece = pieces.begin(); piece != others; ++piece) of_one_pixel += piece->count;
  for (const PointPiece& piece : pieces) selection.points += piece.count;
  if (selection.points == 0) return selection;
  PointRange all = stream_.stream(pieces);
  PointRange pixels = all;
  pixels.count = of_one_pixel;
  pixels.one_pixel = true;
  all.first += of_one_pixel;
  all.count -= of_one_pixel;
  for (const PointRange& range : {pixels, all})
    if (range.count > 0) selection.items.push_back(range);
  return selection;
}

}  // namespace stipple
