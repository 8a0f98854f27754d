// COPC files, read by the npm package copc, too. Skips without node and without `scripts/oracles`.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>

#include "octree/cloud/cloud.h"
#include "octree/open/open.h"
#include "octree/store/open_tree.h"
#include "tests/oracles/oracle.h"

namespace stipple::test::octree_copc_oracle {
namespace {

using Sums = std::array<std::int64_t, 3>;

std::vector<std::string> lines_of(const std::vector<StoredNode>& nodes) {
  std::vector<std::string> lines;
  for (const StoredNode& node : nodes)
    lines.push_back(fmt::format("{}-{}-{}-{} {}", node.level, node.cell.x, node.cell.y, node.cell.z, node.points));
  std::ranges::sort(lines);
  return lines;
}

class CopcOracle : public testing::TestWithParam<const char*> {};

TEST_P(CopcOracle, SeesTheSameNodesAndPoints) {
  SKIP_WITHOUT_ORACLE("copc");
  const std::string path = std::string(STIPPLE_SHARED_DATA "/") + GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is not there";
  const auto source = open_source(path);
  ASSERT_EQ(source->info().format, "COPC");
  const bool has_rgb = find_attribute(source->info().schema, "rgb").has_value();
  const Cloud cloud = load_cloud(*source, has_rgb ? std::vector<std::string>{"rgb"} : std::vector<std::string>{});
  Sums position{}, rgb{};
  for (const glm::ivec3& point : cloud.positions)
    for (int axis = 0; axis < 3; ++axis) position[axis] += point[axis];
  if (has_rgb) {
    const auto values = cloud.columns.at(0).as<std::uint16_t>();
    for (std::size_t i = 0; i < values.size(); ++i) rgb[i % 3] += values[i];
  }

  const auto seen = ask_oracle("copc.mjs", path);
  ASSERT_TRUE(seen);
  EXPECT_EQ(seen->at("nodes").get<std::vector<std::string>>(), lines_of(read_whole_hierarchy(*open_tree(path))));
  EXPECT_EQ(seen->at("points"), cloud.size());
  EXPECT_EQ(seen->at("position").get<Sums>(), position);
  EXPECT_EQ(seen->at("rgb").get<Sums>(), rgb);
}

INSTANTIATE_TEST_SUITE_P(All, CopcOracle,
                         testing::Values("gadomski+las-rs/data/autzen.copc.laz",
                                         "PDAL+PDAL/copc/1.2-with-color.copc.laz",
                                         "laspy+laspy/data/simple_with_page.copc.laz",
                                         "visgl+loaders.gl/modules/copc/test/data/ellipsoid.copc.laz",
                                         "PDAL+PDAL/copc/lone-star.copc.laz", "potree+potree/lion_takanawa.copc.laz"));

}  // namespace
}  // namespace stipple::test::octree_copc_oracle
