// The kd tree: how it divides a cloud, and that what is on disk is the whole cloud.
#include <gtest/gtest.h>

#include <cmath>

#include "octree/build/kd/kd_builder.h"
#include "octree/build/kd/kd_partition.h"
#include "src/check/check_tree.h"
#include "tests/octree/stream_build_fixture.h"

namespace stipple::test::octree_kd_tree {
namespace {

constexpr std::size_t kLeaf = 500;

TestCloud terrain_cloud() {
  return {"terrain", terrain(40'000, 3)};
}

TEST(KdPartition, SplitsAtTheMeanOfTheLongestAxisIntoTightBoxes) {
  for (const TestCloud& cloud : test_clouds()) {
    SCOPED_TRACE(cloud.name);
    std::vector<CodedPoint> points(cloud.positions.size());
    for (std::uint32_t i = 0; i < points.size(); ++i) points[i] = {0, i, i};
    const std::vector<KdNode> nodes = kd_partition(cloud.grid, cloud.positions, points, kLeaf);
    ASSERT_EQ(nodes.empty(), points.empty());
    if (nodes.empty()) continue;
    EXPECT_EQ(nodes.front().count, points.size());
    for (const KdNode& node : nodes) {
      GridBox box;
      glm::dvec3 sum(0.0);
      for (const CodedPoint& point : std::span(points).subspan(node.first, node.count)) {
        box.extend(cloud.positions[point.id]);
        sum += glm::dvec3(cloud.positions[point.id]);
      }
      ASSERT_EQ(node.box, box);
      if (node.children == KdNode::kNone) {
        EXPECT_TRUE(node.count <= kLeaf || box.min == box.max || node.level == kMaxStoredLevel);
        continue;
      }
      const KdNode& lower = nodes[node.children];
      const KdNode& upper = nodes[node.children + 1];
      ASSERT_EQ(lower.first, node.first);
      ASSERT_EQ(upper.first, node.first + lower.count);
      ASSERT_EQ(lower.count + upper.count, node.count);
      ASSERT_GT(lower.count, 0u);
      ASSERT_GT(upper.count, 0u);
      const glm::dvec3 size = (glm::dvec3(box.max) - glm::dvec3(box.min)) * cloud.grid.scale;
      int axis = 0;
      for (int a = 1; a < 3; ++a)
        if (size[a] > size[axis]) axis = a;
      const double mean = sum[axis] / static_cast<double>(node.count);
      EXPECT_LE(lower.box.max[axis], std::floor(mean) + 1e-3);
      EXPECT_GT(upper.box.min[axis], mean - 1e-3);
    }
  }
}

class KdTree : public StreamBuild {
 protected:
  BuildReport build_kd(const Sources& sources, const std::string& name, const StreamOptions& options) const {
    BuildMonitor monitor;
    return build_kd_tree(sources, path(name), options, monitor);
  }
  std::string error_of_build(const Sources& sources, const StreamOptions& options) const {
    try {
      build_kd(sources, "refused", options);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }
};

TEST_F(KdTree, HoldsEveryPointOnceWithAllItCarries) {
  int number = 0;
  for (const TestCloud& cloud : test_clouds()) {
    SCOPED_TRACE(cloud.name);
    const Sources sources = sources_of(cloud);
    const std::string name = "kd" + std::to_string(number++);
    const BuildReport report = build_kd(sources, name, small_nodes());
    EXPECT_EQ(report.points, cloud.positions.size());
    const ReadTree tree = read_tree(path(name));
    EXPECT_EQ(tree.info.source.format, "kd tree");
    EXPECT_TRUE(tree.info.source.warnings.empty());
    EXPECT_TRUE(tree.info.has_details);
    EXPECT_EQ(tree.sorted_records(), sorted_records(*sources.front()));
    const TreeReport checked = check_tree(*open_tree(path(name)));
    EXPECT_FALSE(checked.defect) << checked.defect->what;
    for (const ReadNode& node : tree.nodes) {
      // Inner nodes are empty, but for the root and its sample
      if (node.node.level > 0) {
        EXPECT_EQ(node.node.is_leaf(), node.node.points > 0);
      }
      ASSERT_TRUE(node.node.box);
    }
  }
}

TEST_F(KdTree, IsTheSameOnAnyNumberOfThreads) {
  const Sources sources = sources_of(terrain_cloud());
  StreamOptions options = small_nodes();
  for (const int threads : {1, 4}) {
    options.threads = threads;
    options.replace = true;
    build_kd(sources, "threads" + std::to_string(threads), options);
  }
  for (const char* file : {"kdtree.json", "hierarchy.bin", "boxes.bin", "octree.bin", "stipple.bin"}) {
    const std::string one = file_content(path("threads1") + "/" + file);
    ASSERT_FALSE(one.empty());
    if (std::string(file) == "kdtree.json") continue;  // it holds the folder's name
    EXPECT_TRUE(one == file_content(path("threads4") + "/" + file)) << file;
  }
}

TEST_F(KdTree, ReplacesOnlyWhatItMay) {
  const Sources sources = sources_of(terrain_cloud());
  StreamOptions options = small_nodes();
  build_kd(sources, "tree", options);
  EXPECT_THROW(build_kd(sources, "tree", options), Error);
  options.replace = true;
  build_kd(sources, "tree", options);
  build(sources, "tree", options);
  EXPECT_EQ(read_tree(path("tree")).info.source.format, "Potree octree");
}

TEST_F(KdTree, RefusesWhatMemoryHasNoRoomFor) {
  const Sources sources = sources_of(terrain_cloud());
  StreamOptions options = small_nodes();
  options.memory = 10'000;
  EXPECT_NE(error_of_build(sources, options).find("--memory"), std::string::npos);
  options = small_nodes();
  options.encoding = potree2::Encoding::brotli;
  EXPECT_NE(error_of_build(sources, options), "");
  EXPECT_EQ(entries(), 0u);
}

TEST_F(KdTree, DamagedBoxesAreAnError) {
  build_kd(sources_of(terrain_cloud()), "tree", small_nodes());
  const std::string boxes = path("tree") + "/boxes.bin";
  const std::string whole = file_content(boxes);
  const auto write = [&](const std::string& content) { std::ofstream(boxes, std::ios::binary) << content; };
  write(whole.substr(0, whole.size() - 1));
  EXPECT_THROW(open_tree(path("tree")), Error);
  std::string moved = whole;
  moved[24 + 3] = static_cast<char>(0x80);  // the lower child begins far below the root
  write(moved);
  EXPECT_THROW(open_tree(path("tree")), Error);
  fs::remove(boxes);
  EXPECT_THROW(open_tree(path("tree")), Error);
}

}  // namespace
}  // namespace stipple::test::octree_kd_tree
