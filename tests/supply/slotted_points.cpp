// Points cut into slots for the pool.
#include <gtest/gtest.h>

#include <random>
#include <set>

#include "render/store/cluster_pool.h"

namespace stipple::test::supply_slotted_points {
namespace {

TEST(SlottedPoints, EverySlotHasItsPointsAndABoxAroundThem) {
  std::mt19937 random(7);
  for (const std::uint32_t count : {1u, 2u, 127u, 128u, 129u, 192u, 255u, 300u, 2'000u, 5'001u, 20'000u, 100'003u}) {
    std::vector<PackedPoint> points(count);
    for (PackedPoint& point : points)
      for (int axis = 0; axis < 3; ++axis) point.position[axis] = static_cast<int>(random() % 5'000);
    const SlottedPoints slotted = stipple::slotted({}, points, 1'000, 8'192.0);
    EXPECT_EQ(slotted.slots(), SlottedPoints::slots_for(count));
    ASSERT_EQ(slotted.points.size(), slotted.slots() * SlottedPoints::kPoints);
    std::set<std::uint32_t> seen;
    for (std::uint32_t s = 0; s < slotted.slots(); ++s) {
      const ClusterTable::Row& row = slotted.rows[s];
      ASSERT_LE(row.count, SlottedPoints::kPoints);
      for (std::uint32_t i = 0; i < SlottedPoints::kPoints; ++i) {
        const std::size_t at = s * SlottedPoints::kPoints + i;
        const std::uint32_t id = slotted.ids[at];
        EXPECT_EQ(slotted.points[at].position, points[id - 1'000].position);
        EXPECT_TRUE((GridBox{row.low, row.high}.contains(slotted.points[at].position)));
        EXPECT_EQ(seen.insert(id).second, i < row.count);
      }
    }
    EXPECT_EQ(seen.size(), count);
  }
}

}  // namespace
}  // namespace stipple::test::supply_slotted_points
