#include "render/store/shards.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <set>
#include <utility>

#include "render/store/cluster_cut.h"

namespace stipple::test::supply_shards {
namespace {

std::vector<PackedPoint> points_at(const std::vector<glm::ivec3>& positions) {
  std::vector<PackedPoint> points;
  for (const glm::ivec3& position : positions) points.push_back({position, 0});
  return points;
}

std::vector<PackedPoint> random_points(std::size_t count, std::int32_t low, std::int32_t high) {
  std::mt19937 random(5);
  std::uniform_int_distribution<std::int32_t> number(low, high);
  std::vector<glm::ivec3> positions;
  for (std::size_t i = 0; i < count; ++i) positions.push_back({number(random), number(random), number(random)});
  return points_at(positions);
}

GridBox box_of(const std::vector<PackedPoint>& points) {
  GridBox box;
  for (const PackedPoint& point : points) box.extend(point.position);
  return box;
}

// Whether `position` lies in the cells of a shard.
bool holds(const ShardBox& box, const GridBox& cluster, const glm::ivec3& position) {
  for (int axis = 0; axis < 3; ++axis) {
    const double edge = static_cast<double>(cluster.max[axis]) - cluster.min[axis];
    const double from = cluster.min[axis] + edge / 1024 * (box.first >> 10 * axis & 1023u);
    const double to = cluster.min[axis] + edge / 1024 * ((box.last >> 10 * axis & 1023u) + 1);
    if (position[axis] < from || position[axis] > to) return false;
  }
  return true;
}

struct Dealt {
  std::vector<std::uint32_t> order;
  ShardBoxes boxes;
};

Dealt dealt(const std::vector<PackedPoint>& points) {
  Dealt result{std::vector<std::uint32_t>(points.size()), {}};
  std::iota(result.order.begin(), result.order.end(), 0u);
  std::shuffle(result.order.begin(), result.order.end(), std::mt19937(6));
  result.boxes = deal_to_shards(Grid{}, result.order, points, box_of(points));
  return result;
}

TEST(Shards, HoldEveryPointInTheBoxOfItsPlace) {
  constexpr std::int32_t kMost = std::numeric_limits<std::int32_t>::max();
  for (const std::size_t count : {1u, 2u, 63u, 64u, 65u, 127u, 200u, 256u, 1'000u})
    for (const std::int32_t reach : {0, 1, 20, 100'000, kMost}) {
      const std::vector<PackedPoint> points = random_points(count, -reach, reach);
      const Dealt result = dealt(points);
      for (std::size_t place = 0; place < count; ++place)
        EXPECT_TRUE(holds(result.boxes[place % kShards], box_of(points), points[result.order[place]].position))
            << count << " within " << reach << ", place " << place;
      std::vector<std::uint32_t> sorted = result.order;
      std::sort(sorted.begin(), sorted.end());
      for (std::uint32_t i = 0; i < count; ++i) EXPECT_EQ(sorted[i], i);
    }
}

// 16 x 16 points, which make 8 x 8 shards.
std::vector<PackedPoint> square() {
  std::vector<glm::ivec3> positions;
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) positions.push_back({x, y, 0});
  return points_at(positions);
}

TEST(Shards, AreNeighbours) {
  const std::vector<PackedPoint> points = square();
  const Dealt result = dealt(points);
  for (std::uint32_t shard = 0; shard < kShards; ++shard) {
    GridBox box;
    for (std::size_t place = shard; place < points.size(); place += kShards)
      box.extend(points[result.order[place]].position);
    EXPECT_EQ(box.max - box.min, glm::ivec3(1, 1, 0));
  }
}

TEST(Shards, AreAllOverTheClusterHoweverFewComeFirst) {
  const std::vector<PackedPoint> points = square();
  const Dealt result = dealt(points);
  for (const int cells : {1, 2, 4, 8}) {
    std::set<std::pair<int, int>> reached;
    for (int place = 0; place < cells * cells; ++place) {
      const glm::ivec3 position = points[result.order[static_cast<std::size_t>(place)]].position;
      reached.insert({position.x * cells / 16, position.y * cells / 16});
    }
    EXPECT_EQ(reached.size(), static_cast<std::size_t>(cells * cells)) << "each of them, by its first points";
  }
}

TEST(Shards, KeepTheOrderInWhichTheirPointsWere) {
  const std::vector<PackedPoint> points = random_points(250, -100, 100);
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  deal_to_shards(Grid{}, order, points, box_of(points));
  for (std::size_t place = kShards; place < order.size(); ++place) EXPECT_LT(order[place - kShards], order[place]);
}

TEST(Shards, AreThoseOfEveryClusterOfACut) {
  const std::vector<PackedPoint> points = random_points(5'000, 0, 1'000);
  const ClusterCut cut = cut_clusters(Grid{}, box_of(points), points, 256, 1'024.0);
  ASSERT_EQ(cut.shards.size(), cut.clusters.size());
  for (std::size_t c = 0; c < cut.clusters.size(); ++c)
    for (std::uint32_t place = 0; place < cut.clusters[c].count; ++place)
      EXPECT_TRUE(holds(cut.shards[c][place % kShards], cut.clusters[c].box,
                        points[cut.order[cut.clusters[c].first + place]].position));
}

}  // namespace
}  // namespace stipple::test::supply_shards
