// What every generated scene promises, whichever it is.
#include "src/scene/scene.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <vector>

#include "octree/cloud/cloud.h"
#include "octree/core/error.h"

namespace stipple::test::scene_test {
namespace {

const std::vector<std::string> kAttributes{"rgb", "intensity", "classification"};

Cloud load(const std::string& name, std::uint64_t points, std::uint64_t seed = 1) {
  return load_cloud(*make_scene(name, points, seed), kAttributes);
}

bool same_bytes(const Cloud& a, const Cloud& b) {
  if (a.positions != b.positions) return false;
  for (std::size_t c = 0; c < a.columns.size(); ++c)
    if (a.columns[c].bytes != b.columns[c].bytes) return false;
  return true;
}

class EveryScene : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Scenes, EveryScene, testing::ValuesIn(scene_names()),
                         [](const auto& scene) { return scene.param; });

TEST_P(EveryScene, HasExactlyThePointsAskedFor) {
  for (const std::uint64_t points : {0, 1, 2, 65535, 65536, 65537}) {
    const auto source = make_scene(GetParam(), points, 3);
    EXPECT_EQ(source->info().point_count, points);
    std::vector<std::uint8_t> seen(points);
    source->read({}, [&](const PointBatch& batch) {
      EXPECT_TRUE(batch.columns.empty());
      for (std::size_t i = 0; i < batch.positions.size(); ++i) ++seen.at(batch.first + i);
    });
    EXPECT_EQ(std::ranges::count(seen, 1), static_cast<std::ptrdiff_t>(points));
  }
}

TEST_P(EveryScene, IsTheSameOnOneThreadAndTwo) {
  constexpr std::uint64_t kPoints = 140'000;
  const auto with_threads = [](std::size_t threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    return load(GetParam(), kPoints);
  };
  EXPECT_TRUE(same_bytes(with_threads(1), with_threads(2)));
}

TEST_P(EveryScene, DiffersWithTheSeed) {
  EXPECT_FALSE(same_bytes(load(GetParam(), 5000, 1), load(GetParam(), 5000, 2)));
}

TEST_P(EveryScene, LiesWithinItsStatedBounds) {
  const Cloud cloud = load(GetParam(), 100'000);
  const WorldBox box = world_box(cloud.info.grid, cloud.bounds);
  const WorldBox& stated = cloud.info.stated_bounds;
  EXPECT_TRUE(glm::all(glm::greaterThanEqual(box.min, stated.min)));
  EXPECT_TRUE(glm::all(glm::lessThanEqual(box.max, stated.max)));
}

TEST_P(EveryScene, GivesTheColumnsAskedForInTheirOrder) {
  const auto source = make_scene(GetParam(), 1000, 1);
  const std::vector<std::size_t> classes_then_colours{2, 0};
  const Cloud all = load(GetParam(), 1000);
  source->read(classes_then_colours, [&](const PointBatch& batch) {
    ASSERT_EQ(batch.columns.size(), 2u);
    EXPECT_EQ(batch.columns[0].attribute.name, "classification");
    EXPECT_EQ(batch.columns[0].bytes, all.columns[2].bytes);
    EXPECT_EQ(batch.columns[1].bytes, all.columns[0].bytes);
  });
}

TEST_P(EveryScene, ColoursAreSixteenBitAndVaried) {
  const Cloud cloud = load(GetParam(), 20'000);
  const auto rgb = cloud.find("rgb")->as<std::uint16_t>();
  EXPECT_TRUE(std::ranges::all_of(rgb, [](std::uint16_t v) { return v % 257 == 0; }));
  const auto [low, high] = std::ranges::minmax(rgb);
  EXPECT_LT(low, 40 * 257);
  EXPECT_GT(high, 180 * 257);
}

// Sum over the three colours, in 8-bit steps.
double colour_difference(std::span<const std::uint16_t> rgb, std::size_t a, std::size_t b) {
  double sum = 0;
  for (std::size_t c = 0; c < 3; ++c) sum += std::abs(rgb[3 * a + c] - rgb[3 * b + c]) / 257.0;
  return sum;
}

TEST_P(EveryScene, NeighboursAreColouredAlike) {
  constexpr std::uint64_t kPoints = 150'000;
  const Cloud cloud = load(GetParam(), kPoints);
  const auto rgb = cloud.find("rgb")->as<std::uint16_t>();

  // Sort by cells of a metre; those that share a cell are neighbours
  const glm::dvec3 cells_per_metre = cloud.info.grid.scale / 1.0;
  std::vector<std::pair<std::array<int, 3>, std::size_t>> cells(kPoints);
  for (std::size_t i = 0; i < kPoints; ++i) {
    const glm::ivec3 cell(glm::dvec3(cloud.positions[i]) * cells_per_metre);
    cells[i] = {{cell.x, cell.y, cell.z}, i};
  }
  std::ranges::sort(cells);
  double near = 0;
  double far = 0;
  int pairs = 0;
  for (std::size_t i = 1; i < kPoints; ++i) {
    if (cells[i].first != cells[i - 1].first) continue;
    near += colour_difference(rgb, cells[i].second, cells[i - 1].second);
    far += colour_difference(rgb, cells[i].second, cells[(i * 7919) % kPoints].second);
    ++pairs;
  }
  ASSERT_GT(pairs, 300);
  EXPECT_LT(near, 0.7 * far) << near / pairs << " against " << far / pairs << " over " << pairs << " pairs";
}

TEST(Scene, UnknownNameListsTheKnownOnes) {
  try {
    make_scene("village", 1, 1);
    FAIL();
  } catch (const UsageError& error) {
    for (const std::string& name : scene_names())
      EXPECT_NE(std::string(error.what()).find(name), std::string::npos) << error.what();
  }
}

TEST(Scene, TooManyPointsAreRefused) {
  EXPECT_THROW(make_scene("city", kMaxScenePoints + 1, 1), UsageError);
}

TEST(Scene, EveryNameIsDescribedInASentence) {
  for (const std::string& name : scene_names()) EXPECT_EQ(describe_scene(name).back(), '.');
}

}  // namespace
}  // namespace stipple::test::scene_test
