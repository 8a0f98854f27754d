// What becomes of a picture when its octree cannot be read, or slowly.
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>

#include "octree/core/stopwatch.h"
#include "render/method/progressive_renderer.h"
#include "render/store/tree_ids.h"
#include "tests/render/city_tree.h"

namespace stipple::test::render_failing_disk {
namespace {

bool is_bad(const StoredNode& node) {
  return node.level == 2 && node.cell.x == 1;
}

// The city in memory, without the points of bad nodes.
PointSet without_bad_nodes() {
  const TreeStore& tree = *city(true).tree;
  const PointSet& all = city(true).points;
  std::vector<std::pair<std::uint32_t, std::uint32_t>> bad;  // ids: the first, how many
  for (const StoredNode& node : locate_all(tree, read_whole_hierarchy(tree)))
    if (is_bad(node)) bad.emplace_back(first_id_of(node), static_cast<std::uint32_t>(node.points));
  PointSet rest{.grid = all.grid, .bounds = all.bounds, .points = {}, .ids = {}};
  std::vector<PackedPoint> points;
  std::vector<std::uint32_t> ids;
  for (std::size_t i = 0; i < all.size(); ++i) {
    const std::uint32_t id = all.id(i);
    if (std::ranges::any_of(bad, [&](const auto& range) { return id - range.first < range.second; })) continue;
    points.push_back(all.points[i]);
    ids.push_back(id);
  }
  rest.points.resize(points.size());
  rest.ids.resize(ids.size());
  std::ranges::copy(points, rest.points.begin());
  std::ranges::copy(ids, rest.ids.begin());
  return rest;
}

class FailingDisk : public testing::TestWithParam<Mode> {
 protected:
  static constexpr std::uint32_t kBudget = 60'000;  // all of the city: lod draws no more

  std::unique_ptr<Method> method(std::shared_ptr<const TreeStore> tree) const {
    Dataset dataset = city(false);
    dataset.tree = std::move(tree);
    return make_method(GetParam(), dataset, {.largest_budget = kBudget});
  }
  static FrameData converged(Method& method, const View& view) {
    return converged_picture(method, RasterizerKind::compute, city(false).points.grid, view, kBudget);
  }
  static FrameData brute_force(const PointSet& points, const View& view) {
    return brute_force_picture(points, RasterizerKind::compute, view);
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, FailingDisk, testing::Values(Mode::hybrid, Mode::hierarchical, Mode::lod),
                         [](const auto& param) { return std::string(name_of(param.param)); });

TEST_P(FailingDisk, WhatFailsTwiceIsTriedOnceMore) {
  const auto twice = [](const StoredNode&, int n) { return n <= 2; };
  const auto drawn = method(std::make_shared<FaultyTree>(city(false).tree, twice, twice));
  const View view = view_of_city("oblique");
  EXPECT_TRUE(same_picture(converged(*drawn, view), brute_force(city(true).points, view)));
  EXPECT_EQ(drawn->unread().parts, 0u);
}

TEST_P(FailingDisk, APictureDoesWithoutPointsThatCannotBeRead) {
  const auto bad = [](const StoredNode& node, int) { return is_bad(node); };
  const auto drawn = method(std::make_shared<FaultyTree>(city(false).tree, bad));
  const PointSet rest = without_bad_nodes();
  ASSERT_LT(rest.size(), kCityPoints * 19 / 20);
  for (const char* camera : {"aerial", "oblique"}) {
    const View view = view_of_city(camera);
    EXPECT_TRUE(same_picture(converged(*drawn, view), brute_force(rest, view)));
    EXPECT_GT(drawn->unread().parts, 0u);
    EXPECT_TRUE(drawn->unread().first.ends_with(": the disk is gone")) << drawn->unread().first;
  }
}

TEST_P(FailingDisk, APictureDoesWithoutNodesThatCannotBeLookedUp) {
  const auto bad = [](const StoredNode& node, int) { return is_bad(node); };
  const auto drawn = method(std::make_shared<FaultyTree>(city(false).tree, FaultyTree::Rule(), bad));
  const PointSet rest = without_bad_nodes();
  const View view = view_of_city("aerial");
  EXPECT_TRUE(same_picture(converged(*drawn, view), brute_force(rest, view)));
  EXPECT_GT(drawn->unread().parts, 0u);
}

TEST_P(FailingDisk, TheNextViewAsksAgain) {
  std::atomic<bool> gone = true;
  const auto rule = [&](const StoredNode& node, int) { return gone && is_bad(node); };
  const auto drawn = method(std::make_shared<FaultyTree>(city(false).tree, rule, rule));
  ProgressiveRenderer renderer(*drawn, RasterizerKind::compute, city(false).points.grid);
  const auto draw = [&](const View& view) {
    while (!renderer.draw(view, kBudget).converged) {
    }
  };
  draw(view_of_city("aerial"));
  EXPECT_GT(drawn->unread().parts, 0u);
  gone = false;
  const View view = view_of_city("oblique");
  draw(view);
  EXPECT_EQ(drawn->unread().parts, 0u);
  EXPECT_TRUE(same_picture(renderer.read(), brute_force(city(true).points, view)));
}

// Nothing comes from the disk. A still picture may wait for it a moment, in every frame; a moving one must not.
TEST(SlowDisk, KeepsNoMovingPictureOfLodWaiting) {
  std::atomic<bool> stalls = false;
  const auto rule = [&](const StoredNode&, int) {
    while (stalls) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    return false;
  };
  Dataset dataset = city(false);
  dataset.tree = std::make_shared<FaultyTree>(city(false).tree, rule);
  const auto lod = make_method(Mode::lod, dataset, {.largest_budget = 60'000});
  ProgressiveRenderer renderer(*lod, RasterizerKind::compute, dataset.points.grid);
  View view = view_of(city(true), "low", {64, 36});
  while (!renderer.draw(view, 60'000).converged) {
  }
  stalls = true;
  const auto seconds = [&](const glm::dvec3& step) {
    const Stopwatch watch;
    for (int frame = 0; frame < 30; ++frame) {
      view.eye += step;
      renderer.draw(view, 60'000);
    }
    return watch.seconds();
  };
  view = view_of(city(true), "aerial", {64, 36});
  renderer.draw(view, 60'000);
  const double still = seconds(glm::dvec3(0.0));
  const double moving = seconds(glm::dvec3(0.1));
  stalls = false;
  EXPECT_LT(moving, 0.5 * still);
}

}  // namespace
}  // namespace stipple::test::render_failing_disk
