// Level of detail: what its budget holds, and no more.
#include "render/method/lod.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <thread>

#include "render/method/progressive_renderer.h"
#include "tests/render/city_tree.h"

namespace stipple::test::render_lod {
namespace {

constexpr std::uint64_t kPoints = 60'000;

TEST(Lod, ABudgetForAllGivesTheBruteForcePicture) {
  const Dataset& dataset = scene("city", kPoints);
  for (const RasterizerKind rasterizer : {RasterizerKind::points, RasterizerKind::compute}) {
    const View view = view_of(dataset, "oblique");
    const auto method = make_method(Mode::lod, dataset.points, &*dataset.octree);
    EXPECT_TRUE(same_picture(converged_picture(*method, rasterizer, dataset.points.grid, view, kPoints),
                             brute_force_picture(dataset.points, rasterizer, view)));
  }
}

TEST(Lod, StopsAtTheBudgetAndGrowsWithIt) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  std::uint64_t last = 0;
  for (const std::uint32_t budget : {0u, 5'000u, 20'000u, 60'000u}) {
    const auto method = make_method(Mode::lod, dataset.points, &*dataset.octree);
    ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid);
    const FrameReport report = renderer.draw(view, budget);
    EXPECT_TRUE(report.converged);
    EXPECT_LE(report.points_filled, budget);
    EXPECT_GE(report.points_filled, last);
    last = report.points_filled;
  }
  EXPECT_GT(last, 30'000u);
}

// The nodes that are drawn are a tree's upper part: no node is without those above it that are in sight.
TEST(Lod, CoarseNodesComeFirst) {
  const Dataset& dataset = scene("terrain", kPoints);
  const View view = view_of(dataset, "aerial");
  MemoryLod source(dataset.points, *dataset.octree);
  std::vector<LodSource::Part> parts = source.visible(view);
  ASSERT_GT(parts.size(), 3u);
  std::ranges::sort(parts, std::greater{}, &LodSource::Part::urgency);
  const Node& root = dataset.octree->nodes.front();
  EXPECT_LT(parts.front().key - root.first, root.count);
}

class LodOnDisk : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(All, LodOnDisk,
                         testing::Values("derived/potree2/lion-brotli", "potree+potree/lion_takanawa_ept_bin",
                                         "potree+potree/lion_takanawa.copc.laz"));

TEST_P(LodOnDisk, DrawsWithoutLoadingTheTree) {
  const std::filesystem::path path = std::filesystem::path(STIPPLE_SHARED_DATA) / GetParam();
  if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing: real trees are not tested";
  const Dataset loaded = open_dataset(path, "", {});
  const Dataset on_disk = open_dataset(path, "", {.points = false});
  const auto method = make_method(Mode::lod, on_disk, {.largest_budget = 1'000'000});
  const View view = view_of(loaded, "oblique");
  EXPECT_TRUE(same_picture(converged_picture(*method, RasterizerKind::compute, on_disk.points.grid, view, 1'000'000),
                           brute_force_picture(loaded.points, RasterizerKind::compute, view)));
  // With room for a part of it: what has room is drawn, again and again, and the end is reached
  const auto cramped = make_method(Mode::lod, on_disk, {.largest_budget = 100'000, .limits = {.gpu = 1'000'000}});
  for (const char* camera : {"oblique", "low", "aerial"})
    EXPECT_GT(
        converged_picture(*cramped, RasterizerKind::compute, on_disk.points.grid, view_of(loaded, camera), 100'000)
            .covered_pixels(),
        0u);
}

TEST(Lod, ShowsTheLastPictureUntilTheDiskHasGivenPoints) {
  const View view = view_of_city("oblique");
  const auto before = make_method(Mode::hybrid, city(false), {.largest_budget = 50'000});
  ProgressiveRenderer renderer(*before, RasterizerKind::compute, city(false).points.grid);
  for (FrameReport report; !report.converged;) report = renderer.draw(view, 50'000);
  const std::uint64_t covered = renderer.covered_pixels();

  std::atomic<int> slow_reads = 8;
  const auto slow = std::make_shared<FaultyTree>(city(false).tree, [&](const StoredNode&, int) {
    if (--slow_reads >= 0) std::this_thread::sleep_for(std::chrono::milliseconds(100));
    return false;
  });
  Lod lod(std::make_unique<TreeLod>(slow, city(false).colors, 0, 5'000));
  renderer.use(lod);
  EXPECT_EQ(renderer.draw(view, kPoints).points_filled, 0u);
  EXPECT_EQ(renderer.covered_pixels(), covered);
  EXPECT_EQ(renderer.points_reprojected(), covered);
  FrameReport report;
  while (!report.converged) report = renderer.draw(view, kPoints);
  EXPECT_GT(report.points_filled, 0u);
  EXPECT_EQ(renderer.points_reprojected(), 0u);
  EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(city(true).points, RasterizerKind::compute, view)));
}

}  // namespace
}  // namespace stipple::test::render_lod
