// Mode hybrid on a tree on disk: the pool.
#include "render/method/tree_clusters.h"

#include <gtest/gtest.h>

#include <chrono>
#include <thread>

#include "render/method/hybrid.h"
#include "render/method/progressive_renderer.h"
#include "tests/render/city_tree.h"

namespace stipple::test::render_tree_clusters {
namespace {

FrameData expected(const View& view) {
  return brute_force_picture(city(true).points, RasterizerKind::compute, view);
}

std::unique_ptr<Method> hybrid_of(std::shared_ptr<const TreeStore> tree, std::uint32_t slots,
                                  std::uint64_t points_ahead = 20'000) {
  return std::make_unique<Hybrid>(
      std::make_unique<TreeClusters>(std::move(tree), city(false).colors, 0,
                                     TreeClusters::Options{.slots = slots, .points_ahead = points_ahead}),
      ClusterSelector::Options{.largest_budget = 50'000});
}

FrameData converged(Method& method, const View& view, std::uint32_t budget) {
  return converged_picture(method, RasterizerKind::compute, city(false).points.grid, view, budget);
}

class AnyPool : public testing::TestWithParam<std::uint32_t> {};
INSTANTIATE_TEST_SUITE_P(Slots, AnyPool, testing::Values(2, 10, 100, 400, 5'000), testing::PrintToStringParamName());

TEST_P(AnyPool, ConvergesToBruteForce) {
  for (const char* camera : {"oblique", "low"})
    for (const std::uint32_t budget : {900u, 50'000u})
      EXPECT_TRUE(same_picture(converged(*hybrid_of(city(false).tree, GetParam()), view_of_city(camera), budget),
                               expected(view_of_city(camera))))
          << camera << " " << budget;
}

TEST_P(AnyPool, ConvergesToBruteForceAfterTheCameraMoved) {
  const auto method = hybrid_of(city(false).tree, GetParam(), 3'000);
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, city(false).points.grid);
  const View start = view_of_city("oblique");
  View view = start;
  for (int frame = 0; frame < 30; ++frame) {
    if (frame % 3 == 0) view.eye = start.eye + start.right * (5.0 * frame) + start.forward * (9.0 * frame);
    renderer.draw(view, 3'000);
  }
  for (const char* camera : {"low", "aerial"}) {
    renderer.draw(view_of_city(camera), 3'000);
    renderer.draw(view_of_city(camera), 3'000);
  }
  while (!renderer.draw(view, 11'000).converged) {
  }
  EXPECT_TRUE(same_picture(renderer.read(), expected(view)));
}

TEST_P(AnyPool, ConvergesToBruteForceForTwoEyes) {
  const auto method = hybrid_of(city(false).tree, GetParam());
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, city(false).points.grid);
  View view = view_of(city(true), "low", {160, 90});
  renderer.draw(view, 5'000);
  view.eyes_apart = 30.0;
  while (!renderer.draw(view, 5'000).converged) {
  }
  for (std::size_t eye = 0; eye < 2; ++eye)
    EXPECT_TRUE(same_picture(renderer.read(eye), expected(view.of_eye(eye)))) << eye;
}

TEST(TreeClusters, DrawEachPointAtMostOnceForAStillView) {
  const auto method = hybrid_of(city(false).tree, 5'000);
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, city(false).points.grid);
  std::uint64_t filled = 0;
  for (FrameReport report; !report.converged;) {
    report = renderer.draw(view_of_city("aerial"), 7'000);
    EXPECT_LE(report.points_filled, 7'000u);
    filled += report.points_filled;
  }
  EXPECT_LE(filled, kCityPoints);
}

TEST(TreeClusters, ASecondLookReadsNothingThatThePoolHolds) {
  const auto method = hybrid_of(city(false).tree, 5'000);
  converged(*method, view_of_city("aerial"), 50'000);
  const std::uint64_t before = method->counts().bytes_read;
  EXPECT_TRUE(same_picture(converged(*method, view_of_city("aerial"), 50'000), expected(view_of_city("aerial"))));
  EXPECT_EQ(method->counts().bytes_read, before);
}

TEST(TreeClusters, WhatIsHiddenIsNotRead) {
  const auto read = [](bool skip) {
    Hybrid method(std::make_unique<TreeClusters>(city(false).tree, city(false).colors, city(false).tree->bytes_read(),
                                                 TreeClusters::Options{.slots = 5'000, .points_ahead = 2'000}),
                  {.largest_budget = 4'000, .skips = {.occlusion = skip}});
    View view = view_of_city("low");
    view.size = {64, 36};
    converged(method, view, 4'000);
    return method.counts().bytes_read;
  };
  EXPECT_LT(read(true), read(false) * 97 / 100);  // how much less depends on how fast the disk is
}

TEST(TreeClusters, ASlowDiskKeepsNoFrameWaiting) {
  const auto tree = std::make_shared<FaultyTree>(city(false).tree, [](const StoredNode& node, int) {
    if (node.level >= 2) std::this_thread::sleep_for(std::chrono::milliseconds(20));
    return false;
  });
  const auto method = hybrid_of(tree, 5'000);
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, city(false).points.grid);
  const View view = view_of_city("oblique");
  std::uint64_t frames = 1;
  while (!renderer.draw(view, 50'000).converged) ++frames;
  EXPECT_GT(frames, 3u);
  EXPECT_TRUE(same_picture(renderer.read(), expected(view)));
}

}  // namespace
}  // namespace stipple::test::render_tree_clusters
