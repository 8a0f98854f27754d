// Mode hybrid on a tree on disk: the pool, and what may happen to the disk.
#include "render/method/tree_clusters.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <functional>
#include <map>
#include <mutex>
#include <thread>

#include "octree/build/stream/tree_builder.h"
#include "octree/core/error.h"
#include "octree/open/open.h"
#include "render/method/hybrid.h"
#include "render/method/progressive_renderer.h"
#include "src/scene/scene.h"
#include "tests/octree/las_fixture.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_tree_clusters {
namespace {

constexpr std::uint64_t kPoints = 60'000;

// The city as a tree of small nodes and clusters, made once.
const Dataset& city(bool loaded) {
  static const ScratchFolder folder;
  static const std::string path = [] {
    std::vector<std::unique_ptr<PointSource>> sources;
    sources.push_back(make_scene("city", kPoints, 1));
    StreamOptions options;
    options.leaf_capacity = 2'000;
    options.cluster_points = 300;
    BuildMonitor monitor;
    build_tree(sources, folder.path("tree"), options, monitor);
    return folder.path("tree");
  }();
  static const Dataset in_memory = open_dataset(path, "", {});
  static const Dataset on_disk = open_dataset(path, "", {.points = false});
  return loaded ? in_memory : on_disk;
}

View view_of_city(const char* camera) {
  return view_of(city(true), camera);
}

FrameData expected(const View& view) {
  return brute_force_picture(city(true).points, RasterizerKind::compute, view);
}

std::unique_ptr<Method> hybrid_of(std::shared_ptr<const TreeStore> tree, std::uint32_t slots,
                                  std::uint64_t points_ahead = 20'000) {
  return std::make_unique<Hybrid>(
      std::make_unique<TreeClusters>(std::move(tree), city(false).colors, 0,
                                     TreeClusters::Room{.slots = slots, .points_ahead = points_ahead}),
      ClusterSelector::Options{.largest_budget = 50'000, .skip_occluded = true, .by_yield = true});
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
  EXPECT_LE(filled, kPoints);
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
                                                 TreeClusters::Room{.slots = 5'000, .points_ahead = 2'000}),
                  {.largest_budget = 4'000, .skip_occluded = skip, .by_yield = true});
    View view = view_of_city("low");
    view.size = {64, 36};
    converged(method, view, 4'000);
    return method.counts().bytes_read;
  };
  EXPECT_LT(read(true), read(false) * 97 / 100);  // how much less depends on how fast the disk is
}

// A tree whose reads may fail.
class FaultyTree final : public TreeStore {
 public:
  // Whether the n-th read of points [first, ...) of this node fails.
  using Rule = std::function<bool(const StoredNode&, std::uint64_t first, int n)>;

  FaultyTree(std::shared_ptr<const TreeStore> tree, Rule fails) : tree_(std::move(tree)), fails_(std::move(fails)) {}

  const TreeInfo& info() const override { return tree_->info(); }
  HierarchyPiece root_piece() const override { return tree_->root_piece(); }
  HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const override {
    return tree_->read_piece(where, parent);
  }
  StoredNode locate(const StoredNode& node) const override { return tree_->locate(node); }
  bool reads_parts() const override { return tree_->reads_parts(); }
  NodeDetails read_details(const StoredNode& node) const override { return tree_->read_details(node); }
  void read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const override {
    read_part(node, 0, node.points, attributes, batch);
  }
  void read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                 std::span<const std::size_t> attributes, PointBatch& batch) const override {
    int n = 0;
    {
      const std::lock_guard lock(mutex_);
      n = ++reads_[{name_of(node), first}];
    }
    if (fails_(node, first, n)) throw Error(name_of(node) + ": the disk is gone");
    tree_->read_part(node, first, count, attributes, batch);
  }

 private:
  std::shared_ptr<const TreeStore> tree_;
  Rule fails_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<std::string, std::uint64_t>, int> reads_;
};

TEST(TreeClusters, AFailedReadIsTriedAgain) {
  const auto tree =
      std::make_shared<FaultyTree>(city(false).tree, [](const StoredNode&, std::uint64_t, int n) { return n <= 2; });
  const View view = view_of_city("oblique");
  EXPECT_TRUE(same_picture(converged(*hybrid_of(tree, 300), view, 5'000), expected(view)));
}

TEST(TreeClusters, WhatCannotBeReadIsReportedWhenAllElseIsDrawn) {
  const auto tree = std::make_shared<FaultyTree>(
      city(false).tree, [](const StoredNode& node, std::uint64_t, int) { return node.level == 2 && node.cell.x == 1; });
  const auto method = hybrid_of(tree, 5'000);
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, city(false).points.grid);
  const View view = view_of_city("aerial");
  std::string message;
  for (FrameReport report; !report.converged && message.empty();) try {
      report = renderer.draw(view, 5'000);
    } catch (const Error& error) {
      message = error.what();
    }
  EXPECT_NE(message.find("the disk is gone"), std::string::npos) << message;
  const FrameData whole = expected(view);
  const FrameData picture = renderer.read();
  std::size_t right = 0;
  for (std::size_t i = 0; i < whole.ids.size(); ++i) right += picture.ids[i] == whole.ids[i];
  EXPECT_LT(right, whole.ids.size());
  EXPECT_GT(right, whole.ids.size() * 3 / 5);
  // The picture stays, and the program goes on
  EXPECT_TRUE(renderer.draw(view, 5'000).converged);
}

TEST(TreeClusters, ASlowDiskKeepsNoFrameWaiting) {
  const auto tree = std::make_shared<FaultyTree>(city(false).tree, [](const StoredNode& node, std::uint64_t, int) {
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
