// Trees that PotreeConverter 2 made of real clouds, where they are there.
#include <gtest/gtest.h>

#include <fstream>

#include "octree/cloud/cloud.h"
#include "octree/store/tree_source.h"
#include "src/check/check_tree.h"
#include "tests/octree/potree2_files.h"

namespace stipple::test::octree_potree2_catalog {
namespace {

namespace fs = std::filesystem;

const fs::path kData = STIPPLE_SHARED_DATA;
const fs::path kTrees = kData / "derived/potree2";

class Potree2Catalog : public testing::Test {
 protected:
  void SetUp() override {
    if (!fs::exists(kTrees)) GTEST_SKIP() << "no shared data at " << kTrees;
  }
};

void expect_whole(const std::string& name, std::uint64_t points, std::size_t nodes) {
  SCOPED_TRACE(name);
  const auto store = open_tree((kTrees / name).string());
  const TreeReport report = check_tree(*store);
  EXPECT_FALSE(report.defect) << report.defect->node << ": " << report.defect->what;
  EXPECT_EQ(store->info().source.point_count, points);
  EXPECT_EQ(report.points, points);
  EXPECT_EQ(report.nodes, nodes);

  const Cloud cloud = load_cloud(*open_source((kTrees / name).string()), {"rgb", "intensity"});
  EXPECT_EQ(cloud.size(), points);
  const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
  for (int axis = 0; axis < 3; ++axis) {
    EXPECT_NEAR(box.min[axis], cloud.info.stated_bounds.min[axis], 0.0015);
    EXPECT_NEAR(box.max[axis], cloud.info.stated_bounds.max[axis], 0.0015);
  }
}

TEST_F(Potree2Catalog, BothTreesCountRightAndCheck) {
  expect_whole("lion-brotli", 341'989, 119);
  expect_whole("huacayccancha-uncompressed", 654'569, 241);
}

struct Look {
  std::uint16_t intensity;
  std::uint16_t rgb[3];
  auto operator<=>(const Look&) const = default;
};

// Intensity and colour of every point, and the sum of all positions.
struct Summary {
  std::vector<Look> looks;
  glm::dvec3 sum{0.0};
};

// The lion as the Potree project publishes it in EPT: 36-byte records, see ept.json beside them.
Summary lion_of_ept() {
  const glm::dvec3 offset(-2.0, 4.0, -1.0);
  Summary summary;
  for (const auto& entry : fs::directory_iterator(kData / "potree+potree/lion_takanawa_ept_bin/ept-data")) {
    std::ifstream file(entry.path(), std::ios::binary);
    const std::string bytes{std::istreambuf_iterator<char>(file), {}};
    for (std::size_t at = 0; at + 36 <= bytes.size(); at += 36) {
      glm::ivec3 position;
      Look look;
      std::memcpy(&position, bytes.data() + at, 12);
      std::memcpy(&look.intensity, bytes.data() + at + 12, 2);
      std::memcpy(look.rgb, bytes.data() + at + 26, 6);
      summary.looks.push_back(look);
      summary.sum += offset + 0.001 * glm::dvec3(position);
    }
  }
  std::ranges::sort(summary.looks);
  return summary;
}

TEST_F(Potree2Catalog, TheBrotliLionIsTheOneOfAnotherFormat) {
  const Cloud cloud = load_cloud(*open_source((kTrees / "lion-brotli").string()), {"rgb", "intensity"});
  Summary ours;
  for (std::size_t i = 0; i < cloud.size(); ++i) {
    const auto* rgb = cloud.find("rgb")->as<std::uint16_t>().data() + 3 * i;
    ours.looks.push_back({cloud.find("intensity")->as<std::uint16_t>()[i], {rgb[0], rgb[1], rgb[2]}});
    ours.sum += cloud.info.grid.world_from_grid(cloud.positions[i]);
  }
  std::ranges::sort(ours.looks);
  const Summary theirs = lion_of_ept();
  EXPECT_EQ(ours.looks, theirs.looks);
  // Both are rounded to 0.001
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(ours.sum[axis] / 341'989.0, theirs.sum[axis] / 341'989.0, 0.001);
}

}  // namespace
}  // namespace stipple::test::octree_potree2_catalog
