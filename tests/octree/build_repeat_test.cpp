// What an octree depends on and what not; what the builder refuses.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include "octree/build/builder.h"
#include "octree/core/error.h"
#include "tests/octree/octree_clouds.h"

namespace stipple::test::octree_build_repeat_test {
namespace {

const test::TestCloud& large_cloud() {
  static const test::TestCloud cloud{"terrain", test::terrain(1'000'000, 21)};
  return cloud;
}

Octree build(const test::TestCloud& cloud, const BuildOptions& options = {}) {
  return build_octree(cloud.grid, cloud.bounds(), cloud.positions, options);
}

template <class A, class B>
bool same_run(const A& a, const B& b) {
  return a.first == b.first && a.count == b.count && a.box == b.box && a.profile.occupied == b.profile.occupied;
}

void expect_same(const Octree& a, const Octree& b) {
  EXPECT_EQ(a.cube.min, b.cube.min);
  EXPECT_EQ(a.cube.edge, b.cube.edge);
  EXPECT_EQ(a.order, b.order);
  ASSERT_EQ(a.clusters.size(), b.clusters.size());
  for (std::size_t c = 0; c < a.clusters.size(); ++c) ASSERT_TRUE(same_run(a.clusters[c], b.clusters[c])) << c;
  ASSERT_EQ(a.nodes.size(), b.nodes.size());
  for (std::size_t n = 0; n < a.nodes.size(); ++n) {
    const Node &one = a.nodes[n], &other = b.nodes[n];
    ASSERT_TRUE(same_run(one, other)) << n;
    ASSERT_EQ(
        std::tie(one.parent, one.children, one.level, one.cell, one.first_cluster, one.cluster_count),
        std::tie(other.parent, other.children, other.level, other.cell, other.first_cluster, other.cluster_count));
    ASSERT_EQ(one.subtree_box, other.subtree_box);
  }
}

TEST(BuildOctree, DoesNotDependOnTheNumberOfThreads) {
  const Octree expected = build(large_cloud());
  for (const std::size_t threads : {1u, 2u, 5u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    expect_same(build(large_cloud()), expected);
  }
}

class BuildOctreeOf : public testing::TestWithParam<test::TestCloud> {};
INSTANTIATE_TEST_SUITE_P(Clouds, BuildOctreeOf, testing::ValuesIn(test::test_clouds()), test::cloud_name);

TEST_P(BuildOctreeOf, DoesNotDependOnTheSizeOfChunks) {
  BuildOptions options{.leaf_capacity = 300, .cluster_points = 100};
  const Octree expected = build(GetParam(), options);
  for (const std::size_t chunk_points : {1u, 1'000u, 7'000u}) {
    options.chunk_points = chunk_points;
    expect_same(build(GetParam(), options), expected);
  }
}

TEST(BuildOctree, DependsOnTheSeed) {
  EXPECT_NE(build(large_cloud(), {.seed = 1}).order, build(large_cloud(), {.seed = 2}).order);
}

TEST(BuildOctree, TakesPositionsInsideLargerRecords) {
  struct Record {
    glm::ivec3 position;
    std::uint32_t color;
  };
  const test::TestCloud cloud{"terrain", test::terrain(50'000, 22)};
  std::vector<Record> records;
  for (const glm::ivec3& p : cloud.positions) records.push_back({p, 0xdeadbeef});
  const PositionView view(std::span<const Record>(records), &Record::position);
  expect_same(build_octree(cloud.grid, cloud.bounds(), view), build(cloud));
}

TEST(BuildOctree, RefusesAPointOutsideTheBounds) {
  const std::vector<glm::ivec3> positions{{0, 0, 0}, {1, 2, 3}};
  EXPECT_THROW(build_octree(Grid{}, {{0, 0, 0}, {1, 2, 2}}, positions), Error);
}

TEST(BuildOctree, RefusesOptionsOfZero) {
  const std::vector<glm::ivec3> positions{{0, 0, 0}};
  const GridBox bounds{{0, 0, 0}, {0, 0, 0}};
  EXPECT_THROW(build_octree(Grid{}, bounds, positions, {.leaf_capacity = 0}), Error);
  EXPECT_THROW(build_octree(Grid{}, bounds, positions, {.cluster_points = 0}), Error);
}

TEST(BuildOctree, DividesDownToSinglePointsWhenAskedTo) {
  const test::TestCloud cloud{"terrain", test::terrain(500, 23)};
  const Octree octree = build(cloud, {.leaf_capacity = 1, .cluster_points = 1, .chunk_points = 1});
  EXPECT_EQ(octree.order.size(), cloud.positions.size());
  for (const Cluster& cluster : octree.clusters) ASSERT_EQ(cluster.count, 1u);
}

}  // namespace
}  // namespace stipple::test::octree_build_repeat_test
