#include "render/store/shards.h"

#include <algorithm>
#include <vector>

#include "octree/cloud/longest_axis.h"

namespace stipple {
namespace {

// A point by its place in the shuffled cluster.
struct Placed {
  glm::ivec3 position;
  std::uint32_t place;
};

GridBox box_of(std::span<const Placed> points) {
  GridBox box;
  for (const Placed& point : points) box.extend(point.position);
  return box;
}

ShardBox pack(const GridBox& shard, const GridBox& cluster) {
  constexpr std::int64_t kCells = 1 << ShardBox::kBits;
  ShardBox packed;
  for (int axis = 0; axis < 3; ++axis) {
    const std::int64_t low = cluster.min[axis];
    const std::int64_t edge = std::max<std::int64_t>(cluster.max[axis] - low, 1);
    const auto cell = [&](std::int64_t x) {
      return static_cast<std::uint32_t>(std::min((x - low) * kCells / edge, kCells - 1));
    };
    packed.first |= cell(shard.min[axis]) << ShardBox::kBits * axis;
    packed.last |= cell(shard.max[axis]) << ShardBox::kBits * axis;
  }
  return packed;
}

// The shard that is the leaf-th of the tree of halves: its bits backwards, so that shards next in number are far apart.
std::uint32_t shard_at(std::uint32_t leaf) {
  std::uint32_t shard = 0;
  for (std::uint32_t bit = 1; bit < kShards; bit *= 2) shard = 2 * shard + (leaf & bit ? 1 : 0);
  return shard;
}

class Dealer {
 public:
  Dealer(const Grid& grid, std::span<const std::uint32_t> cluster, std::span<const PackedPoint> points,
         const GridBox& box)
      : grid_(grid), cluster_box_(box), points_(cluster.size()), shard_of_(cluster.size()) {
    for (std::uint32_t i = 0; i < cluster.size(); ++i) points_[i] = {points[cluster[i]].position, i};
    for (std::uint32_t leaf = 0; leaf < kShards; ++leaf)
      before_[leaf + 1] =
          before_[leaf] + points_.size() / kShards + (shard_at(leaf) < points_.size() % kShards ? 1 : 0);
    split(points_, 0, kShards);
  }

  const ShardBoxes& boxes() const { return boxes_; }
  // Of the point at `place` of the shuffled cluster.
  std::uint32_t shard_of(std::size_t place) const { return shard_of_[place]; }

 private:
  // Halves the points of these leaves across the longest edge of their box until each half is a shard.
  void split(std::span<Placed> points, std::uint32_t first, std::uint32_t end) {
    if (points.empty()) return;
    const GridBox box = box_of(points);
    if (end - first == 1) {
      const std::uint32_t shard = shard_at(first);
      boxes_[shard] = pack(box, cluster_box_);
      for (const Placed& point : points) shard_of_[point.place] = static_cast<std::uint8_t>(shard);
      return;
    }
    const std::uint32_t middle = (first + end) / 2;
    const std::size_t below = before_[middle] - before_[first];
    if (below < points.size())
      std::nth_element(points.begin(), points.begin() + static_cast<std::ptrdiff_t>(below), points.end(),
                       [axis = longest_axis(grid_, box)](const Placed& a, const Placed& b) {
                         return a.position[axis] < b.position[axis];
                       });
    split(points.first(below), first, middle);
    split(points.subspan(below), middle, end);
  }

  Grid grid_;
  GridBox cluster_box_;
  std::vector<Placed> points_;
  std::vector<std::uint8_t> shard_of_;
  std::array<std::size_t, kShards + 1> before_{};  // points of the leaves before: place k is in shard k % kShards
  ShardBoxes boxes_{};
};

}  // namespace

ShardBoxes deal_to_shards(const Grid& grid, std::span<std::uint32_t> cluster, std::span<const PackedPoint> points,
                          const GridBox& box) {
  const Dealer dealer(grid, cluster, points, box);
  const std::vector<std::uint32_t> shuffled(cluster.begin(), cluster.end());
  std::array<std::size_t, kShards> next;
  for (std::uint32_t s = 0; s < kShards; ++s) next[s] = s;
  for (std::size_t i = 0; i < shuffled.size(); ++i) {
    std::size_t& place = next[dealer.shard_of(i)];
    cluster[place] = shuffled[i];
    place += kShards;
  }
  return dealer.boxes();
}

}  // namespace stipple
