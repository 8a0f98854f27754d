// Counting covered pixels, and runs of one view: when they stop and what they add up to.
#include <gtest/gtest.h>

#include <vector>

#include "render/frame/vertex_carry.h"
#include "render/method/brute_force.h"
#include "src/run/view_run.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_stats {
namespace {

constexpr glm::ivec2 kOddSizes[] = {{1, 1}, {1, 7}, {16, 8}, {17, 3}, {15, 9}, {129, 65}, {1281, 719}};

FeedbackTarget drawn_target(const PointSet& points, const View& view, RasterizerKind kind) {
  const auto rasterizer = make_rasterizer(kind, false);
  FeedbackTarget target(view.size, rasterizer->depth_storage());
  const GpuCloud cloud = upload_in_order(points);
  std::vector<DrawItem> items;
  cloud.append_items(0, cloud.size(), items);
  ViewUniforms uniforms;
  uniforms.set(make_view_block(view, points.grid, 1.0));
  rasterizer->draw(target, items);
  return target;
}

TEST(CoverageCounter, CountsWhatTheFrameHoldsAtAnySize) {
  CoverageCounter counter;
  const PointSet points = random_points(30'000, 1'500, 4);
  for (const RasterizerKind kind : {RasterizerKind::points, RasterizerKind::compute})
    for (const glm::ivec2& size : kOddSizes) {
      const View view = front_view(2.0, size);
      const FeedbackTarget target = drawn_target(points, view, kind);
      const std::size_t covered = target.read(view.near).covered_pixels();
      EXPECT_GT(covered, 0u);
      EXPECT_EQ(counter.count(target.ids()), covered) << size.x << "x" << size.y;
    }
}

TEST(CoverageCounter, AClearedTargetIsEmpty) {
  CoverageCounter counter;
  const View view = front_view(2.0, {33, 21});
  FeedbackTarget target = drawn_target(random_points(5'000, 1'500, 4), view, RasterizerKind::compute);
  ASSERT_GT(counter.count(target.ids()), 0u);
  target.clear();
  EXPECT_EQ(counter.count(target.ids()), 0u);
  EXPECT_EQ(target.read(view.near).covered_pixels(), 0u);
}

// A run with all its frames.
struct RunLog {
  FrameState end;
  std::vector<FrameState> frames;
};

constexpr std::uint64_t kPoints = 60'000;

RunLog run_city(Mode mode, const BudgetPolicy& policy, const Until& until, std::uint64_t points = kPoints) {
  const Dataset& dataset = scene("city", points);
  const auto method = make_method(mode, dataset.points, &*dataset.octree, {.largest_budget = largest_budget(policy)});
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid);
  RunLog run;
  run.end = run_view(renderer, view_of(dataset, "oblique", {161, 89}), policy, until,
                     [&](const FrameState& state) { run.frames.push_back(state); });
  return run;
}

TEST(ViewRun, StopsWhenConverged) {
  for (const Mode mode : all_modes()) {
    const RunLog run = run_city(mode, {.points = 7'000, .frames_per_second = {}}, {});
    EXPECT_TRUE(run.end.converged) << name_of(mode);
    for (std::size_t i = 0; i + 1 < run.frames.size(); ++i) EXPECT_FALSE(run.frames[i].converged);
  }
}

TEST(ViewRun, StopsAfterTheFramesAskedFor) {
  for (const std::uint64_t frames : {1u, 3u}) {
    const RunLog run = run_city(Mode::unstructured, {.points = 1'000, .frames_per_second = {}},
                                {.frames = frames, .milliseconds = {}});
    EXPECT_EQ(run.end.frame, frames);
    EXPECT_EQ(run.end.points_drawn, 1'000 * frames);
    EXPECT_FALSE(run.end.converged);
  }
}

TEST(ViewRun, StopsAfterTheFirstFrameBeyondTheTime) {
  const RunLog run =
      run_city(Mode::unstructured, {.points = 100, .frames_per_second = {}}, {.frames = {}, .milliseconds = 1e-6});
  EXPECT_EQ(run.end.frame, 1u);
}

TEST(ViewRun, ConvergedComesBeforeTheOtherLimits) {
  const RunLog run = run_city(Mode::brute_force, {}, {.frames = 100, .milliseconds = 1e9});
  EXPECT_EQ(run.end.frame, 1u);
  EXPECT_TRUE(run.end.converged);
  EXPECT_EQ(run.end.points_drawn, kPoints);
}

TEST(ViewRun, SumsRunOverTheFrames) {
  for (const Mode mode : {Mode::hierarchical, Mode::unstructured}) {
    const RunLog run = run_city(mode, {.points = 7'000, .frames_per_second = {}}, {});
    std::uint64_t reprojected = 0;
    double milliseconds = 0.0;
    for (std::size_t i = 0; i < run.frames.size(); ++i) {
      const FrameState& state = run.frames[i];
      EXPECT_EQ(state.frame, i + 1);
      EXPECT_EQ(state.budget, 7'000u);
      EXPECT_EQ(state.points_reprojected, reprojected);
      reprojected += state.covered_pixels;  // all of them are drawn again in the next
      EXPECT_GE(state.milliseconds, milliseconds);
      milliseconds = state.milliseconds;
      if (i + 1 < run.frames.size()) {
        EXPECT_EQ(state.points_drawn, 7'000 * (i + 1));
      }
    }
    EXPECT_LE(run.end.points_drawn, kPoints);
    EXPECT_EQ(run.end.covered_pixels, run.frames.back().covered_pixels);
  }
}

TEST(ViewRun, CoverageNeverFallsForAStillCamera) {
  const RunLog run = run_city(Mode::hierarchical, {.points = 5'000, .frames_per_second = {}}, {});
  for (std::size_t i = 1; i < run.frames.size(); ++i)
    EXPECT_GE(run.frames[i].covered_pixels, run.frames[i - 1].covered_pixels);
}

TEST(ViewRun, AnUnreachableFrameRateFallsToTheLeastBudget) {
  const RunLog run = run_city(Mode::unstructured, {.points = 1, .frames_per_second = 1e9},
                              {.frames = 12, .milliseconds = {}}, 300'000);
  for (std::size_t i = 1; i < run.frames.size(); ++i) EXPECT_LE(run.frames[i].budget, run.frames[i - 1].budget);
  EXPECT_EQ(run.frames.back().budget, BudgetController::Limits{}.least);
}

TEST(ViewRun, AnEasyFrameRateDrawsEverythingAtOnce) {
  const RunLog run = run_city(Mode::unstructured, {.points = 1, .frames_per_second = 1e-3}, {});
  EXPECT_TRUE(run.end.converged);
  EXPECT_EQ(run.end.frame, 1u);
}

TEST(ViewRun, LargestBudgetIsWhatAFrameMayBeAskedFor) {
  EXPECT_EQ(largest_budget({.points = 123, .frames_per_second = {}}), 123u);
  EXPECT_EQ(largest_budget({.points = 123, .frames_per_second = 20.0}), BudgetController::Limits{}.most);
}

TEST(ViewRun, ARendererRunsOnceMoreFromNothing) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique", {161, 89});
  for (const Mode mode : all_modes()) {
    const auto method = make_method(mode, dataset.points, &*dataset.octree);
    ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid);
    const BudgetPolicy policy{.points = 9'000, .frames_per_second = {}};
    const FrameState first = run_view(renderer, view, policy, {});
    const FrameData picture = renderer.read();
    const FrameState second = run_view(renderer, view, policy, {});
    EXPECT_EQ(second.points_drawn, first.points_drawn) << name_of(mode);
    EXPECT_EQ(second.frame, first.frame) << name_of(mode);
    EXPECT_TRUE(same_picture(renderer.read(), picture)) << name_of(mode);
  }
}

TEST(ViewRun, TheObserverSeesTheFrameItIsToldOf) {
  const Dataset& dataset = scene("city", kPoints);
  const auto method = make_method(Mode::unstructured, dataset.points, nullptr);
  ProgressiveRenderer renderer(*method, RasterizerKind::points, dataset.points.grid);
  run_view(renderer, view_of(dataset, "oblique", {161, 89}), {.points = 10'000, .frames_per_second = {}}, {},
           [&](const FrameState& state) { EXPECT_EQ(renderer.read().covered_pixels(), state.covered_pixels); });
}

}  // namespace
}  // namespace stipple::test::render_stats
