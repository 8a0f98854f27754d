#include "render/store/cluster_pool.h"

#include <algorithm>
#include <iterator>

#include "render/store/cluster_cut.h"

namespace stipple {
namespace {

constexpr std::uint32_t kPoints = SlottedPoints::kPoints;
constexpr std::uint32_t kChunkSlots = ClusterTable::kChunkPoints / kPoints;

std::uint32_t place_of(std::uint32_t slot) {
  return slot / kChunkSlots << ClusterTable::kPlaceBits | slot % kChunkSlots * kPoints;
}

// So many points that a cluster never has more than a slot: cut_clusters() makes as many clusters as this goes into all
// of them, rounded, all of the same size but for one point.
std::uint64_t even_cluster_points(std::uint64_t points) {
  return points / ((points + kPoints - 1) / kPoints);
}

}  // namespace

std::uint32_t SlottedPoints::slots_for(std::uint64_t points) {
  if (points == 0) return 0;
  const std::uint64_t each = even_cluster_points(points);
  return static_cast<std::uint32_t>((points + each / 2) / each);
}

SlottedPoints slotted(const Grid& grid, std::span<const PackedPoint> points, std::uint32_t first_id, double root_edge) {
  GridBox bounds;
  for (const PackedPoint& point : points) bounds.extend(point.position);
  SlottedPoints result;
  if (points.empty()) return result;
  ClusterCut cut = cut_clusters(grid, bounds, points, even_cluster_points(points.size()), root_edge);
  result.points.resize(cut.clusters.size() * kPoints);
  result.ids.resize(result.points.size());
  result.log_pixels = std::move(cut.log_pixels);
  result.shards = std::move(cut.shards);
  for (const ClusterCut::Piece& cluster : cut.clusters) {
    const std::size_t to = result.rows.size() * kPoints;
    for (std::size_t i = 0; i < kPoints; ++i) {
      const std::uint32_t from = cut.order[cluster.first + std::min<std::size_t>(i, cluster.count - 1)];
      result.points[to + i] = points[from];
      result.ids[to + i] = first_id + from;
    }
    result.rows.push_back({cluster.box.min, 0, cluster.box.max, cluster.count});
  }
  return result;
}

ClusterPool::ClusterPool(std::uint32_t slots, double root_edge) : free_slots_(slots) {
  table_.allocate(slots);
  table_.root_edge = root_edge;
  if (slots > 0) free_[0] = slots;
}

std::vector<ClusterRun> ClusterPool::put(const SlottedPoints& points, std::uint32_t first, std::uint32_t count) {
  std::vector<ClusterRun> runs;
  while (count > 0) {
    const ClusterRun run = take(count);
    use_up_to(run.first + run.count);
    write(points, first, run);
    runs.push_back(run);
    first += run.count;
    count -= run.count;
  }
  return runs;
}

// The first free run that is long enough, or the longest; of at most `count` slots, and of one chunk.
ClusterRun ClusterPool::take(std::uint32_t count) {
  auto found = free_.begin();
  for (auto run = free_.begin(); run != free_.end(); ++run) {
    if (run->second > found->second) found = run;
    if (run->second >= count) {
      found = run;
      break;
    }
  }
  const auto [first, free] = *found;
  const ClusterRun taken{first, std::min({count, free, kChunkSlots - first % kChunkSlots})};
  free_.erase(found);
  if (taken.count < free) free_[first + taken.count] = free - taken.count;
  free_slots_ -= taken.count;
  return taken;
}

void ClusterPool::use_up_to(std::uint32_t slots) {
  if (slots <= table_.size) return;
  while (table_.chunks.size() * kChunkSlots < slots) {
    const auto first = static_cast<std::uint32_t>(table_.chunks.size()) * kChunkSlots;
    const std::size_t points = std::size_t{std::min(kChunkSlots, table_.capacity - first)} * kPoints;
    table_.chunks.push_back({GpuBuffer(points * sizeof(PackedPoint)), GpuBuffer(points * sizeof(std::uint32_t))});
  }
  table_.size = slots;
}

void ClusterPool::write(const SlottedPoints& points, std::uint32_t from, const ClusterRun& run) {
  ClusterTable::Chunk& chunk = table_.chunks[run.first / kChunkSlots];
  const std::size_t at = std::size_t{run.first % kChunkSlots} * kPoints;
  const std::size_t some = std::size_t{run.count} * kPoints;
  chunk.points.write(at * sizeof(PackedPoint), std::span(points.points).subspan(std::size_t{from} * kPoints, some));
  chunk.ids.write(at * sizeof(std::uint32_t), std::span(points.ids).subspan(std::size_t{from} * kPoints, some));
  std::vector<ClusterTable::Row> rows(points.rows.begin() + from, points.rows.begin() + from + run.count);
  for (std::uint32_t i = 0; i < run.count; ++i) rows[i].place = place_of(run.first + i);
  constexpr std::size_t kFloats = ClusterTable::kLevels;
  table_.write_rows(run.first, rows);
  table_.write_log_pixels(run.first, std::span(points.log_pixels).subspan(from * kFloats, run.count * kFloats));
  table_.write_shards(run.first, std::span(points.shards).subspan(from, run.count));
}

void ClusterPool::free(std::span<const ClusterRun> runs) {
  for (const ClusterRun& run : runs) {
    std::vector<ClusterTable::Row> rows(run.count, ClusterTable::Row{});
    for (std::uint32_t i = 0; i < run.count; ++i) rows[i].place = place_of(run.first + i);
    table_.write_rows(run.first, rows);
    free_slots_ += run.count;
    // Joins its neighbours
    ClusterRun joined = run;
    auto after = free_.lower_bound(run.first);
    if (after != free_.end() && after->first == joined.first + joined.count) {
      joined.count += after->second;
      after = free_.erase(after);
    }
    if (after != free_.begin()) {
      const auto before = std::prev(after);
      if (before->first + before->second == joined.first) {
        joined = {before->first, before->second + joined.count};
        free_.erase(before);
      }
    }
    free_[joined.first] = joined.count;
  }
}

void ClusterPool::append_items(const ClusterRun& run, std::vector<DrawItem>& items, bool one_pixel) const {
  const ClusterTable::Chunk& chunk = table_.chunks[run.first / kChunkSlots];
  items.push_back(PointRange{.points = &chunk.points,
                             .ids = &chunk.ids,
                             .first = run.first % kChunkSlots * kPoints,
                             .count = run.count * kPoints,
                             .one_pixel = one_pixel});
}

}  // namespace stipple
