// Finished nodes are published while the build goes on; sidecar and metadata say what is in the tree.
#include <fcntl.h>

#include <map>
#include <mutex>

#include "octree/build/box_count.h"
#include "octree/build/morton.h"
#include "octree/store/potree2/sidecar.h"
#include "tests/octree/stream_build_fixture.h"

namespace stipple::test::octree_stream_build_publish {
namespace {

TEST_F(StreamBuild, PublishesEveryNodeOnceItCanBeRead) {
  const TestCloud cloud{"terrain", terrain(40'000, 3)};
  std::mutex mutex;
  std::map<std::uint64_t, std::pair<FinishedNode, std::string>> published;  // by offset, with bytes read at once
  BuildMonitor monitor;
  monitor.on_finished = [&](const FinishedNodes& finished) {
    std::ifstream file(finished.points_file, std::ios::binary);
    for (const FinishedNode& node : finished.nodes) {
      std::string bytes(node.byte_size, '\0');
      file.seekg(static_cast<std::streamoff>(node.byte_offset));
      file.read(bytes.data(), static_cast<std::streamsize>(bytes.size()));
      const std::lock_guard lock(mutex);
      EXPECT_TRUE(published.emplace(node.byte_offset, std::pair(node, bytes)).second);
    }
  };
  build_tree(sources_of(cloud), path("tree"), small_nodes(), monitor);
  const std::string octree = file_content(path("tree/octree.bin"));
  std::size_t with_points = 0;
  for (const ReadNode& read : read_tree(path("tree")).nodes) {
    if (read.node.points == 0) continue;
    ++with_points;
    ASSERT_TRUE(published.contains(read.node.byte_offset));
    const auto& [node, bytes] = published.at(read.node.byte_offset);
    EXPECT_EQ(node.level, read.node.level);
    EXPECT_EQ(node.cell, read.node.cell);
    EXPECT_EQ(node.points, read.node.points);
    GridBox box;
    for (const glm::ivec3& p : read.points.positions) box.extend(p);
    EXPECT_EQ(node.box, box);
    EXPECT_TRUE(bytes == octree.substr(node.byte_offset, node.byte_size));
  }
  EXPECT_EQ(published.size(), with_points);
}

TEST_F(StreamBuild, CountsItsProgress) {
  const TestCloud cloud{"terrain", terrain(40'000, 3)};
  BuildMonitor monitor;
  StreamOptions options = small_nodes();
  options.most_in_memory = 9'000;
  const BuildReport report = build_tree(sources_of(cloud), path("tree"), options, monitor);
  const BuildProgress progress = monitor.progress();
  EXPECT_EQ(progress.phase, BuildPhase::finishing);
  EXPECT_EQ(progress.points, 40'000u);
  EXPECT_EQ(progress.counted, 40'000u);
  EXPECT_EQ(progress.built, 40'000u);
  EXPECT_GE(report.bytes_spilled, 40'000u * 12);
  EXPECT_GT(report.bytes_written, report.bytes_spilled);
}

// Points of a node as the sidecar's profiles count them.
BoxCounts profile_of(std::span<const glm::ivec3> positions, const Quantizer& quantizer) {
  std::vector<CodedPoint> coded;
  for (const glm::ivec3& p : positions) coded.push_back({quantizer.code(p), 0, 0});
  std::sort(coded.begin(), coded.end());
  return box_counts(coded);
}

TEST_F(StreamBuild, SidecarDescribesEveryNodeAndItsClusters) {
  const TestCloud cloud{"terrain", terrain(40'000, 3)};
  build(sources_of(cloud), "tree", small_nodes());
  const Quantizer quantizer(cloud.grid, cloud.bounds());
  std::vector<std::string> warnings;
  const auto sidecar = potree2::read_sidecar(path("tree"), 40'000, fs::file_size(path("tree/octree.bin")), warnings);
  ASSERT_TRUE(sidecar);
  EXPECT_EQ(sidecar->header().fraction, kPoissonFraction);
  std::size_t clusters = 0;
  for (const ReadNode& read : read_tree(path("tree")).nodes) {
    if (read.node.points == 0) continue;
    const auto node = sidecar->find(read.node.byte_offset);
    ASSERT_TRUE(node);
    const std::span<const glm::ivec3> positions = read.points.positions;
    EXPECT_EQ(node->profile.occupied, profile_of(positions, quantizer).occupied);
    std::uint32_t next = 0;
    for (const Cluster& cluster : sidecar->clusters(*node)) {
      ASSERT_EQ(cluster.first, next);
      next += cluster.count;
      const auto own = positions.subspan(cluster.first, cluster.count);
      GridBox box;
      for (const glm::ivec3& p : own) box.extend(p);
      EXPECT_EQ(cluster.box, box);
      EXPECT_LE(cluster.count, 150u);
      EXPECT_EQ(cluster.profile.occupied, profile_of(own, quantizer).occupied);
      ++clusters;
    }
    EXPECT_EQ(next, read.node.points);
  }
  EXPECT_EQ(clusters, sidecar->header().clusters);
}

TEST_F(StreamBuild, SidecarOfAnotherTreeVersionOrSizeIsNotUsed) {
  build(sources_of({"terrain", terrain(4'000, 3)}), "tree", small_nodes());
  const std::uint64_t bytes = fs::file_size(path("tree/octree.bin"));
  const std::string good = file_content(path("tree/stipple.bin"));
  const auto warnings_with = [&](const std::string& content, std::uint64_t points) {
    std::ofstream(path("tree/stipple.bin"), std::ios::binary) << content;
    std::vector<std::string> warnings;
    const bool refused = potree2::read_sidecar(path("tree"), points, bytes, warnings) == nullptr;
    EXPECT_EQ(refused, !warnings.empty());
    return warnings.size();
  };
  std::string other_version = good;
  other_version[8] = 9;
  std::string endless = good;
  for (int i = 40; i < 56; ++i) endless[i] = '\xff';
  EXPECT_EQ(warnings_with(good, 4'000), 0u);
  EXPECT_EQ(warnings_with(good, 4'001), 1u);
  EXPECT_EQ(warnings_with(other_version, 4'000), 1u);
  EXPECT_EQ(warnings_with(endless, 4'000), 1u);
  EXPECT_EQ(warnings_with(good.substr(0, good.size() - 1), 4'000), 1u);
  EXPECT_EQ(warnings_with(good.substr(0, 20), 4'000), 1u);
  EXPECT_EQ(warnings_with("", 4'000), 1u);
}

TEST_F(StreamBuild, MetadataHoldRangesAndHistograms) {
  build(sources_of({"terrain", terrain(40'000, 3)}), "tree", small_nodes());
  const TreeInfo info = open_tree(path("tree"))->info();
  ASSERT_EQ(info.ranges.size(), 4u);
  EXPECT_EQ(info.ranges[1].min, (std::vector<double>{0, 0, 0}));
  EXPECT_EQ(info.ranges[1].max, (std::vector<double>{39'999, 2'499, 156}));
  EXPECT_EQ(info.ranges[3].max, (std::vector<double>{19'999.5}));
  ASSERT_EQ(info.ranges[2].histogram.size(), 256u);
  for (std::size_t value = 0; value < 6; ++value) EXPECT_EQ(info.ranges[2].histogram[value], value < 5 ? 8'000u : 0u);
}

}  // namespace
}  // namespace stipple::test::octree_stream_build_publish
