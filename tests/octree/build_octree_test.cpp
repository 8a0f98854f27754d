// What holds for the octree of any cloud, usual or hostile.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <numeric>

#include "octree/build/builder.h"
#include "octree/build/morton.h"
#include "octree/build/sampling.h"
#include "tests/octree/octree_clouds.h"

namespace stipple::test::octree_build_octree_test {
namespace {

// Small, so that small clouds have many levels, chunks and clusters.
constexpr BuildOptions kOptions{.leaf_capacity = 300, .cluster_points = 100, .seed = 1, .chunk_points = 1'500};

class OctreeOf : public testing::TestWithParam<test::TestCloud> {
 protected:
  const test::TestCloud& cloud() const { return GetParam(); }
  glm::ivec3 position(std::uint32_t slot) const { return cloud().positions[octree_.order[slot]]; }

  glm::uvec3 cell_at(std::uint32_t slot, int level) const {
    return Quantizer(octree_.grid, octree_.bounds).cell(position(slot)) >> static_cast<unsigned>(kMaxLevel - level);
  }
  std::uint64_t code_at(std::uint32_t slot, int level) const { return morton_encode(cell_at(slot, level)); }

  template <class Run>
  GridBox box_of(const Run& run) const {
    GridBox box;
    for (std::uint32_t slot = run.first; slot < run.first + run.count; ++slot) box.extend(position(slot));
    return box;
  }

  template <class Run>
  BoxCounts profile_of(const Run& run) const {
    BoxCounts counts;
    for (int level = 0; level <= kMaxLevel; ++level) {
      std::vector<std::uint64_t> cells;
      for (std::uint32_t slot = run.first; slot < run.first + run.count; ++slot) cells.push_back(code_at(slot, level));
      std::sort(cells.begin(), cells.end());
      counts.occupied[level] = static_cast<std::uint32_t>(std::unique(cells.begin(), cells.end()) - cells.begin());
    }
    return counts;
  }

  // Those of `node` and of its ancestors.
  template <class Function>
  void for_each_slot_upwards(const Node& node, const Function& function) const {
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot) function(slot);
    if (node.parent != Node::kNone) for_each_slot_upwards(octree_.nodes[node.parent], function);
  }

  const Octree octree_ = build_octree(GetParam().grid, GetParam().bounds(), GetParam().positions, kOptions);
};

INSTANTIATE_TEST_SUITE_P(Clouds, OctreeOf, testing::ValuesIn(test::test_clouds()), test::cloud_name);

TEST_P(OctreeOf, OrderIsAPermutation) {
  std::vector<std::uint32_t> ids(octree_.order.begin(), octree_.order.end());
  std::sort(ids.begin(), ids.end());
  std::vector<std::uint32_t> expected(cloud().positions.size());
  std::iota(expected.begin(), expected.end(), 0u);
  EXPECT_EQ(ids, expected);
}

TEST_P(OctreeOf, NodesDivideTheSlotsInOrder) {
  std::uint32_t next = 0;
  for (const Node& node : octree_.nodes) {
    ASSERT_EQ(node.first, next);
    next += node.count;
  }
  EXPECT_EQ(next, octree_.order.size());
}

TEST_P(OctreeOf, ClustersDivideTheSlotsOfTheirNode) {
  std::uint32_t next_cluster = 0;
  for (const Node& node : octree_.nodes) {
    ASSERT_EQ(node.first_cluster, next_cluster);
    next_cluster += node.cluster_count;
    std::uint32_t next = node.first;
    for (std::uint32_t c = node.first_cluster; c < next_cluster; ++c) {
      ASSERT_EQ(octree_.clusters[c].first, next);
      next += octree_.clusters[c].count;
    }
    ASSERT_EQ(next, node.first + node.count);
  }
  EXPECT_EQ(next_cluster, octree_.clusters.size());
}

TEST_P(OctreeOf, ClustersOfANodeAreOfOneSize) {
  for (const Node& node : octree_.nodes) {
    if (node.count == 0) continue;
    const auto clusters = std::span(octree_.clusters).subspan(node.first_cluster, node.cluster_count);
    const auto by_count = [](const Cluster& a, const Cluster& b) { return a.count < b.count; };
    const auto [least, most] = std::minmax_element(clusters.begin(), clusters.end(), by_count);
    EXPECT_LE(most->count - least->count, 1u);
    EXPECT_LE(most->count, kOptions.cluster_points * 3 / 2);
    EXPECT_GE(least->count, std::min<std::size_t>(node.count, kOptions.cluster_points * 2 / 3));
  }
}

TEST_P(OctreeOf, EveryPointIsInTheCellOfItsNode) {
  for (const Node& node : octree_.nodes)
    for (std::uint32_t slot = node.first; slot < node.first + node.count; ++slot)
      ASSERT_EQ(cell_at(slot, node.level), node.cell);
}

TEST_P(OctreeOf, BoxesOfNodesAndClustersAreTight) {
  for (const Node& node : octree_.nodes) ASSERT_EQ(node.box, box_of(node));
  for (const Cluster& cluster : octree_.clusters) ASSERT_EQ(cluster.box, box_of(cluster));
}

TEST_P(OctreeOf, SubtreeBoxesAreTight) {
  std::vector<GridBox> boxes;
  for (const Node& node : octree_.nodes) boxes.push_back(box_of(node));
  for (std::size_t i = boxes.size(); i-- > 0;) {
    if (octree_.nodes[i].parent != Node::kNone) boxes[octree_.nodes[i].parent].extend(boxes[i]);
    ASSERT_EQ(octree_.nodes[i].subtree_box, boxes[i]);
  }
}

TEST_P(OctreeOf, ProfilesAreTheNumberOfOccupiedCells) {
  for (const Node& node : octree_.nodes) ASSERT_EQ(node.profile.occupied, profile_of(node).occupied);
  for (const Cluster& cluster : octree_.clusters) ASSERT_EQ(cluster.profile.occupied, profile_of(cluster).occupied);
}

TEST_P(OctreeOf, ParentsAndChildrenPointAtEachOther) {
  std::size_t children = 0;
  for (std::uint32_t i = 0; i < octree_.nodes.size(); ++i) {
    const Node& node = octree_.nodes[i];
    for (unsigned digit = 0; digit < 8; ++digit) {
      if (node.children[digit] == Node::kNone) continue;
      ++children;
      ASSERT_GT(node.children[digit], i);
      const Node& child = octree_.nodes[node.children[digit]];
      ASSERT_EQ(child.parent, i);
      ASSERT_EQ(child.level, node.level + 1);
      ASSERT_EQ(child.cell, node.cell * 2u + glm::uvec3(digit >> 2, digit >> 1 & 1, digit & 1));
    }
  }
  EXPECT_EQ(children + (octree_.nodes.empty() ? 0 : 1), octree_.nodes.size());
}

TEST_P(OctreeOf, NoLeafIsEmpty) {
  for (const Node& node : octree_.nodes) ASSERT_TRUE(node.count > 0 || !node.is_leaf());
}

TEST_P(OctreeOf, CellsAreDividedWhenTheyExceedTheCapacityAndHaveMoreThanOneCode) {
  std::vector<std::size_t> points(octree_.nodes.size());
  for (std::size_t i = points.size(); i-- > 0;) {
    const Node& node = octree_.nodes[i];
    points[i] += node.count;
    if (node.parent != Node::kNone) points[node.parent] += points[i];
    if (!node.is_leaf() || node.count <= kOptions.leaf_capacity) continue;
    // Too large for a leaf: all one code, or a sample that left its children nothing.
    const int lattice = std::min(node.level + kLatticeLevels, kMaxLevel);
    ASSERT_TRUE(node.profile.occupied[kMaxLevel] == 1 || node.profile.occupied[lattice] == node.count);
  }
}

TEST_P(OctreeOf, InnerNodesHoldAtMostOnePointOfALatticeCell) {
  for (const Node& node : octree_.nodes) {
    if (node.is_leaf()) continue;
    const int lattice = std::min(node.level + kLatticeLevels, kMaxLevel);
    ASSERT_EQ(profile_of(node).occupied[lattice], node.count);
  }
}

TEST_P(OctreeOf, InnerNodesAndTheirAncestorsHoldAPointOfEveryOccupiedLatticeCell) {
  const auto lattice_of = [](const Node& node) { return std::min(node.level + kLatticeLevels, kMaxLevel); };
  std::vector<std::vector<std::uint64_t>> held(octree_.nodes.size());
  for (std::size_t i = 0; i < held.size(); ++i) {
    const Node& node = octree_.nodes[i];
    if (node.is_leaf()) continue;
    for_each_slot_upwards(node, [&](std::uint32_t slot) { held[i].push_back(code_at(slot, lattice_of(node))); });
    std::ranges::sort(held[i]);
  }
  for (const Node& leaf : octree_.nodes) {
    for (std::uint32_t up = leaf.parent; up != Node::kNone; up = octree_.nodes[up].parent) {
      for (std::uint32_t slot = leaf.first; slot < leaf.first + leaf.count; ++slot)
        ASSERT_TRUE(std::ranges::binary_search(held[up], code_at(slot, lattice_of(octree_.nodes[up]))));
    }
  }
}

TEST(Octree, OfEqualPointsIsOneLeaf) {
  const std::vector<glm::ivec3> positions(200'000, {5, 5, 5});
  const Octree octree = build_octree(Grid{}, {glm::ivec3(5), glm::ivec3(5)}, positions, kOptions);
  ASSERT_EQ(octree.nodes.size(), 1u);
  EXPECT_EQ(octree.nodes[0].count, 200'000u);
}

TEST(Octree, PrefixOfAClusterIsAnEvenSample) {
  const test::TestCloud cloud{"terrain", test::terrain(400'000, 12)};
  const Octree octree = build_octree(cloud.grid, cloud.bounds(), cloud.positions);
  const Quantizer quantizer(octree.grid, octree.bounds);
  double chi_square = 0.0;
  for (const Cluster& cluster : octree.clusters) {
    std::vector<std::uint64_t> codes;
    for (std::uint32_t slot = cluster.first; slot < cluster.first + cluster.count; ++slot)
      codes.push_back(quantizer.code(cloud.positions[octree.order[slot]]));
    std::vector<std::uint64_t> sorted = codes;
    std::sort(sorted.begin(), sorted.end());
    // How many of the first tenth are in each quarter of the cluster along the Morton curve?
    const std::size_t prefix = codes.size() / 10;
    const double expected = static_cast<double>(prefix) / 4;
    std::array<int, 4> quarters{};
    for (std::size_t i = 0; i < prefix; ++i) {
      const std::size_t place = std::lower_bound(sorted.begin(), sorted.end(), codes[i]) - sorted.begin();
      ++quarters[place * 4 / sorted.size()];
    }
    for (const int count : quarters) chi_square += std::pow(count - expected, 2) / expected / 0.9;  // none drawn twice
  }
  const double mean = chi_square / static_cast<double>(octree.clusters.size());
  EXPECT_NEAR(mean, 3.0, 5 * std::sqrt(6.0 / static_cast<double>(octree.clusters.size())));
}

}  // namespace
}  // namespace stipple::test::octree_build_octree_test
