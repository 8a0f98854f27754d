#include <gtest/gtest.h>

#include <set>

#include "octree/build/builder.h"
#include "octree/select/order.h"
#include "tests/octree/octree_clouds.h"

namespace stipple::test::octree_select_order_test {
namespace {

class VisibleNodesOf : public testing::TestWithParam<test::TestCloud> {
 protected:
  // From beyond a corner of the cube, looking along an edge: sees some of the nodes.
  Frustum frustum() const {
    const glm::dvec3 eye = octree_.cube.min + octree_.cube.edge * glm::dvec3(0.4, -0.1, 0.1);
    return make_frustum(eye, {1, 0, 0}, {0, 0, 1}, {0, 1, 0}, 0.3, 0.3);
  }

  const Octree octree_ = build_octree(GetParam().grid, GetParam().bounds(), GetParam().positions,
                                      {.leaf_capacity = 300, .cluster_points = 100});
};

INSTANTIATE_TEST_SUITE_P(Clouds, VisibleNodesOf, testing::ValuesIn(test::test_clouds()), test::cloud_name);

TEST_P(VisibleNodesOf, AreThoseWhoseOwnBoxMayBeSeen) {
  std::set<std::uint32_t> expected, found;
  for (std::uint32_t i = 0; i < octree_.nodes.size(); ++i)
    if (octree_.nodes[i].count > 0 && may_see(frustum(), world_box(octree_.grid, octree_.nodes[i].box)))
      expected.insert(i);
  for (const VisibleNode& visible : visible_nodes(octree_, frustum())) found.insert(visible.node);
  EXPECT_EQ(found, expected);
}

TEST_P(VisibleNodesOf, ComeFrontToBackAndByNumberAtEqualDistance) {
  const glm::dvec3 eye = frustum().eye;
  const std::vector<VisibleNode> visible = visible_nodes(octree_, frustum());
  for (std::size_t i = 0; i < visible.size(); ++i) {
    EXPECT_EQ(visible[i].distance, nearest_distance(eye, world_box(octree_.grid, octree_.nodes[visible[i].node].box)));
    if (i == 0) continue;
    ASSERT_TRUE(visible[i - 1].distance < visible[i].distance ||
                (visible[i - 1].distance == visible[i].distance && visible[i - 1].node < visible[i].node));
  }
}

TEST_P(VisibleNodesOf, AreNoneWhenTheViewTurnsItsBack) {
  const glm::dvec3 eye = octree_.cube.min - glm::dvec3(1.0);
  const Frustum away = make_frustum(eye, {1, 0, 0}, {0, 0, 1}, {0, -1, 0}, 0.3, 0.3);
  EXPECT_TRUE(visible_nodes(octree_, away).empty());
}

}  // namespace
}  // namespace stipple::test::octree_select_order_test
