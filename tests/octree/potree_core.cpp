// What we write, read by the Potree viewer's own loader. Skips without node and without `scripts/oracles`.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <mutex>
#include <string>

#include "octree/build/stream/tree_builder.h"
#include "src/scene/scene.h"
#include "tests/octree/las_fixture.h"
#include "tests/oracles/oracle.h"

namespace stipple::test::octree_potree_core {
namespace {

using Sums = std::array<std::uint64_t, 3>;

struct Seen {
  std::uint64_t points = 0;
  Sums position{};  // grid coordinates
  Sums rgb{};       // as 8 bits: the loader divides what is above 255 by 256
};

Seen sums_of(const PointSource& source) {
  const std::array attributes{find_attribute(source.info().schema, "rgb").value()};
  Seen seen;
  std::mutex mutex;
  source.read(attributes, [&](const PointBatch& batch) {
    const std::lock_guard lock(mutex);
    seen.points += batch.positions.size();
    for (const glm::ivec3& position : batch.positions)
      for (int axis = 0; axis < 3; ++axis) seen.position[axis] += static_cast<std::uint64_t>(position[axis]);
    const std::span<const std::uint16_t> rgb = batch.columns[0].as<std::uint16_t>();
    for (std::size_t i = 0; i < rgb.size(); ++i) seen.rgb[i % 3] += rgb[i] > 255 ? rgb[i] / 256 : rgb[i];
  });
  return seen;
}

class PotreeCore : public testing::TestWithParam<potree2::Encoding> {};

TEST_P(PotreeCore, SeesEveryPointOfOurTree) {
  SKIP_WITHOUT_ORACLE("potree-core");
  const ScratchFolder folder;
  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(make_scene("city", 200'000, 1));
  StreamOptions options;
  options.encoding = GetParam();
  options.leaf_capacity = 500;  // deeper than a piece of the hierarchy
  BuildMonitor monitor;
  const BuildReport report = build_tree(sources, folder.path("tree"), options, monitor);
  ASSERT_GT(report.depth, 4);

  const auto seen = ask_oracle("potree_core.mjs", folder.path("tree"));
  ASSERT_TRUE(seen);
  const Seen expected = sums_of(*sources.front());
  EXPECT_EQ(seen->at("points"), expected.points);
  EXPECT_EQ(seen->at("position").get<Sums>(), expected.position);
  EXPECT_EQ(seen->at("rgb").get<Sums>(), expected.rgb);
  EXPECT_GE(seen->at("nodes").get<std::uint64_t>(), report.nodes);
}

INSTANTIATE_TEST_SUITE_P(All, PotreeCore, testing::Values(potree2::Encoding::uncompressed, potree2::Encoding::brotli),
                         [](const auto& test) {
                           return test.param == potree2::Encoding::brotli ? "Brotli" : "Default";
                         });

}  // namespace
}  // namespace stipple::test::octree_potree_core
