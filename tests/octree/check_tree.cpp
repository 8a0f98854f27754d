#include "src/check/check_tree.h"

#include <gtest/gtest.h>

#include <functional>

#include "tests/octree/potree2_files.h"

namespace stipple::test::octree_check_tree {
namespace {

using test::Bytes;
using test::contains;
using test::error_of;
using test::put;
using test::ScratchFolder;
using test::TreeFiles;

constexpr std::size_t kNodes = 6;
constexpr std::size_t kClusterBytes = 120;

// Our sidecar for a usual tree: one cluster a node, profiles of a single cell a level.
Bytes sidecar(const TreeFiles& files, double fraction) {
  Bytes bytes(64);
  test::put_text(bytes, 0, "stipple");
  put(bytes, 8, std::uint32_t{1});
  put(bytes, 16, fraction);
  put(bytes, 24, std::uint64_t{files.points()});
  put(bytes, 32, std::uint64_t{files.octree().size()});
  put(bytes, 40, std::uint64_t{files.nodes.size()});
  put(bytes, 48, std::uint64_t{files.nodes.size()});
  const auto put_box_and_profile = [&](const std::vector<test::TreePoint>& points) {
    GridBox box;
    for (const test::TreePoint& point : points) box.extend(point.position);
    for (int axis = 0; axis < 3; ++axis) put(bytes, bytes.size(), box.min[axis]);
    for (int axis = 0; axis < 3; ++axis) put(bytes, bytes.size(), box.max[axis]);
    for (int level = 0; level < 22; ++level) put(bytes, bytes.size(), std::uint32_t{1});
  };
  for (const auto& [name, points] : files.nodes) {
    put(bytes, bytes.size(), std::uint32_t{0});
    put(bytes, bytes.size(), static_cast<std::uint32_t>(points.size()));
    put_box_and_profile(points);
  }
  std::uint64_t offset = 0, index = 0;
  for (const auto& [name, points] : files.nodes) {
    put(bytes, bytes.size(), offset);
    put(bytes, bytes.size(), index++);
    put(bytes, bytes.size(), static_cast<std::uint32_t>(points.size()));
    put(bytes, bytes.size(), std::uint32_t{1});
    put(bytes, bytes.size(), static_cast<std::uint32_t>(name.size() - 1));
    put_box_and_profile(points);
    offset += files.node_bytes(name).size();
  }
  return bytes;
}

// What is wrong with a tree that `damage` has been at, after its files were written.
using Damage = std::function<void(const ScratchFolder&, TreeFiles&)>;

std::optional<Defect> defect_after(const Damage& damage) {
  const ScratchFolder folder;
  TreeFiles files = TreeFiles::usual();
  files.write(folder);
  damage(folder, files);
  return check_tree(*open_tree(folder.path(""))).defect;
}

void expect_defect(const Damage& damage, const std::string& node, const std::string& what) {
  const auto defect = defect_after(damage);
  ASSERT_TRUE(defect);
  EXPECT_EQ(defect->node, node);
  EXPECT_TRUE(contains(defect->what, what));
}

void write_metadata(const ScratchFolder& folder, const Json& metadata) {
  folder.write("metadata.json", TreeFiles::bytes_of(metadata));
}

TEST(CheckTree, AWholeTreeHasNoDefectInAnyEncoding) {
  for (const char* encoding : {"DEFAULT", "BROTLI"}) {
    const ScratchFolder folder;
    const TreeReport report = check_tree(*open_tree(TreeFiles::usual(encoding).write(folder)));
    EXPECT_FALSE(report.defect) << report.defect->what;
    EXPECT_EQ(report.points, 360u);
    EXPECT_EQ(report.nodes, kNodes);
    ASSERT_EQ(report.levels.size(), 3u);
    EXPECT_EQ(report.levels[1].nodes, 3u);
    EXPECT_EQ(report.levels[1].inner_nodes, 2u);
    EXPECT_EQ(report.levels[2].points, 120u);
    EXPECT_EQ(report.levels[1].spacing, 4.0);
    EXPECT_TRUE(std::isfinite(report.levels[1].closest_pair));
    EXPECT_TRUE(std::isinf(report.levels[2].closest_pair));
  }
}

TEST(CheckTree, AnEmptyTreeHasNoDefect) {
  const ScratchFolder folder;
  TreeFiles files;
  files.nodes["r"] = {};
  const TreeReport report = check_tree(*open_tree(files.write(folder)));
  EXPECT_FALSE(report.defect);
  EXPECT_EQ(report.points, 0u);
}

TEST(CheckTree, AnotherNumberOfPointsThanStated) {
  expect_defect(
      [](const ScratchFolder& folder, TreeFiles& files) {
        Json metadata = files.metadata();
        metadata["points"] = 361;
        write_metadata(folder, metadata);
      },
      "", "the metadata state 361 points, and the nodes hold 360");
}

TEST(CheckTree, BytesOfNoNode) {
  expect_defect(
      [](const ScratchFolder& folder, TreeFiles& files) {
        Bytes octree = files.octree();
        octree.resize(octree.size() + 5);
        folder.write("octree.bin", octree);
      },
      "", "the last node's points end at byte 7560, and the file has 7565");
  expect_defect(
      [](const ScratchFolder& folder, TreeFiles& files) {
        Bytes octree = files.octree();
        octree.resize(octree.size() + 5);
        folder.write("octree.bin", octree);
        Bytes hierarchy = files.hierarchy();
        put(hierarchy, files.record_offset("r70") + 6, std::uint64_t{5 * 1260 + 5});
        folder.write("hierarchy.bin", hierarchy);
      },
      "r70", "bytes 6300 to 6305 of the points before it belong to no node");
}

TEST(CheckTree, NodesThatShareBytes) {
  EXPECT_TRUE(contains(error_of([] {
                         defect_after([](const ScratchFolder& folder, TreeFiles& files) {
                           Bytes hierarchy = files.hierarchy();
                           put(hierarchy, files.record_offset("r70") + 6, std::uint64_t{4 * 1260 + 21});
                           folder.write("hierarchy.bin", hierarchy);
                         });
                       }),
                       "node r70 begins at byte 5061 of the points, inside node r7"));
}

TEST(CheckTree, APointOutsideItsCell) {
  const auto move_point_of_r3 = [](int steps_below) {
    return [=](const ScratchFolder& folder, TreeFiles& files) {
      files.nodes["r3"][17].position.y = 1024 - steps_below;
      files.write(folder);
    };
  };
  EXPECT_FALSE(defect_after(move_point_of_r3(1)));
  expect_defect(move_point_of_r3(2), "r3", "its point 17 at (");
}

TEST(CheckTree, TheFirstOffendingNodeIsNamed) {
  expect_defect(
      [](const ScratchFolder& folder, TreeFiles& files) {
        files.nodes["r70"][3].position = glm::ivec3(0);
        files.nodes["r7"][4].position = glm::ivec3(0);
        files.write(folder);
      },
      "r7", "its point 4 at (100, 200, 300) is outside its cell, (612, 712, 812) to (1124, 1224, 1324)");
}

TEST(CheckTree, AValueOutsideTheStatedRange) {
  expect_defect(
      [](const ScratchFolder& folder, TreeFiles& files) {
        Json metadata = files.metadata();
        metadata["attributes"][2]["max"] = {65535, 58000, 65535};
        write_metadata(folder, metadata);
      },
      "r", "rgb of its point 58 is 58077, and 0 to 58000 is the range that the metadata state");
  expect_defect(
      [](const ScratchFolder& folder, TreeFiles& files) {
        Json metadata = files.metadata();
        metadata["attributes"][0]["min"] = {100, 200, 301};
        write_metadata(folder, metadata);
      },
      "r", "z of its point 0 is 300, and 301 to 1324 is the range");
}

TEST(CheckTree, AHistogramThatCountsOtherwise) {
  expect_defect(
      [](const ScratchFolder& folder, TreeFiles& files) {
        Json metadata = files.metadata();
        metadata["attributes"][3]["histogram"][4] = 71;
        write_metadata(folder, metadata);
      },
      "", "classification is 4 in 72 points, and the metadata's histogram says 71");
}

TEST(CheckTree, ANodeThatCannotBeRead) {
  const ScratchFolder folder;
  const TreeFiles files = TreeFiles::usual("BROTLI");
  files.write(folder);
  Bytes octree = files.octree();
  octree.back() ^= std::byte{0xFF};
  octree[octree.size() - 9] ^= std::byte{0xFF};
  folder.write("octree.bin", octree);
  const TreeReport report = check_tree(*open_tree(folder.path("")));
  ASSERT_TRUE(report.defect);
  EXPECT_EQ(report.defect->node, "r70");
  EXPECT_TRUE(contains(report.defect->what, "the 60 points of node r70 were expected"));
}

TEST(CheckTree, DetailsThatFitAreNoDefect) {
  const auto defect = defect_after(
      [](const ScratchFolder& folder, TreeFiles& files) { folder.write("stipple.bin", sidecar(files, 0.0)); });
  EXPECT_FALSE(defect) << defect->what;
}

TEST(CheckTree, APromisedDistanceThatIsBroken) {
  const ScratchFolder folder;
  TreeFiles files = TreeFiles::usual();
  files.write(folder);
  const double closest = check_tree(*open_tree(folder.path(""))).levels[1].closest_pair;
  const double kept = closest / 4.0;  // the spacing of level 1
  EXPECT_FALSE(defect_after(
      [&](const ScratchFolder& other, TreeFiles& same) { other.write("stipple.bin", sidecar(same, 0.999 * kept)); }));
  expect_defect(
      [&](const ScratchFolder& other, TreeFiles& same) { other.write("stipple.bin", sidecar(same, 1.001 * kept)); },
      "r0", "two of its points are ");
}

TEST(CheckTree, DetailsThatDoNotFit) {
  const auto with_sidecar = [](const std::function<void(Bytes&)>& change) {
    return [change](const ScratchFolder& folder, TreeFiles& files) {
      Bytes bytes = sidecar(files, 0.0);
      change(bytes);
      folder.write("stipple.bin", bytes);
    };
  };
  const std::size_t cluster = 64 + kClusterBytes;  // of node r0
  const std::size_t node = 64 + kNodes * kClusterBytes + 140;
  expect_defect(with_sidecar([&](Bytes& b) { put(b, cluster + 4, std::uint32_t{59}); }), "r0",
                "the box of its cluster 0 is not tight");
  expect_defect(
      with_sidecar([&](Bytes& b) { put(b, cluster, std::uint32_t{1}), put(b, cluster + 4, std::uint32_t{59}); }), "r0",
      "its cluster 0 holds 59 points from 1 on");
  expect_defect(with_sidecar([&](Bytes& b) { put(b, cluster + 8, std::int32_t{-1}); }), "r0",
                "the box of its cluster 0 is not tight");
  expect_defect(with_sidecar([&](Bytes& b) { put(b, cluster + 32, std::uint32_t{2}); }), "r0",
                "the box-count profile of its cluster 0");
  expect_defect(with_sidecar([&](Bytes& b) { put(b, node + 28, std::int32_t{-1}); }), "r0", "its box is not tight");
  expect_defect(with_sidecar([&](Bytes& b) { put(b, node + 16, std::uint32_t{61}); }), "r0",
                "node r0 with 60 points on level 1 was expected");
  expect_defect(with_sidecar([&](Bytes& b) { put(b, 24, std::uint64_t{1}); }), "", "belongs to another tree");
}

}  // namespace
}  // namespace stipple::test::octree_check_tree
