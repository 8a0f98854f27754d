// What mode hybrid leaves out, and that it leaves out nothing else.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "render/method/progressive_renderer.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_hybrid {
namespace {

class HybridRasterizer : public testing::TestWithParam<RasterizerKind> {};
INSTANTIATE_TEST_SUITE_P(Rasterizers, HybridRasterizer,
                         testing::Values(RasterizerKind::points, RasterizerKind::compute),
                         [](const auto& param) { return std::string(name_of(param.param)); });

// What a still view takes to converge.
struct Converged {
  std::uint64_t points = 0;
  std::uint64_t frames = 0;
  SelectionCounts counts;
  SkipCounts skipped;
  FrameData picture;
};

Converged converge(const PointSet& points, RasterizerKind kind, const View& view, std::uint32_t budget,
                   const MethodOptions& options = {}) {
  const auto method = make_method(Mode::hybrid, points, nullptr, options);
  ProgressiveRenderer renderer(*method, kind, points.grid);
  Converged run;
  for (FrameReport report; !report.converged;) {
    report = renderer.draw(view, budget);
    run.points += report.points_filled;
    ++run.frames;
  }
  run.counts = method->counts();
  run.skipped = *method->skipped();
  run.picture = renderer.read();
  return run;
}

constexpr int kWallPoints = 100'000;
// Millimetres that the second wall stands behind the first.
constexpr int kGap = 500;

// Two walls across the line of sight of front_view, the second wholly behind the first.
PointSet two_walls() {
  std::mt19937 random(7);
  std::uniform_int_distribution<int> front(-600, 600);
  std::uniform_int_distribution<int> back(-300, 300);
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < kWallPoints; ++i) positions.push_back({front(random), 0, front(random)});
  for (int i = 0; i < kWallPoints; ++i) positions.push_back({back(random), kGap, back(random)});
  return points_at(positions);
}

TEST_P(HybridRasterizer, AHiddenWallIsHardlyDrawn) {
  const PointSet points = two_walls();
  const View view = front_view(1.5, {96, 54});
  const Converged run = converge(points, GetParam(), view, 5'000);
  EXPECT_TRUE(same_picture(run.picture, brute_force_picture(points, GetParam(), view)));
  EXPECT_LT(run.points, kWallPoints * 5 / 4);
  EXPECT_GT(run.counts.nodes_occluded, 200u);

  const Converged all = converge(points, GetParam(), view, 5'000, {.skips = {.occlusion = false}});
  EXPECT_TRUE(same_picture(all.picture, run.picture));
  EXPECT_EQ(all.points, 2u * kWallPoints);
  EXPECT_EQ(all.counts.nodes_occluded, 0u);
}

// A floor that recedes: a pixel shows what would fill thousands, and most of it lies behind the nearest of them, though
// no cluster does.
TEST_P(HybridRasterizer, ASurfaceSeenFromTheSideHidesPartsOfClusters) {
  std::mt19937 random(9);
  std::uniform_int_distribution<int> across(-500, 500);
  std::uniform_int_distribution<int> along(0, 4'000);
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < kWallPoints; ++i) positions.push_back({across(random), along(random), -300});
  const PointSet points = points_at(positions);
  const View view = front_view(1.5, {96, 54});
  const Converged run = converge(points, GetParam(), view, 5'000);
  EXPECT_TRUE(same_picture(run.picture, brute_force_picture(points, GetParam(), view)));
  EXPECT_LT(run.points, 40'000u);  // 53,000 while clusters were hidden as a whole only
}

TEST_P(HybridRasterizer, ATieWithWhatIsDrawnIsNotHidden) {
  // All in one plane: every later point may have the lower id
  std::mt19937 random(8);
  std::uniform_int_distribution<int> place(-100, 100);
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < 50'000; ++i) positions.push_back({place(random), 0, place(random)});
  const PointSet points = points_at(positions);
  const View view = front_view(2.0, {96, 54});
  const Converged run = converge(points, GetParam(), view, 1'000);
  EXPECT_TRUE(same_picture(run.picture, brute_force_picture(points, GetParam(), view)));
  EXPECT_EQ(run.counts.nodes_occluded, 0u);
  EXPECT_EQ(run.points, positions.size());
}

TEST_P(HybridRasterizer, WhateverIsNotSkippedThePictureIsTheSame) {
  const Dataset& dataset = scene("city", 200'000);
  const View view = view_of(dataset, "low", {96, 54});
  const FrameData expected = brute_force_picture(dataset.points, GetParam(), view);
  Skips nothing;
  for (const NamedSkip& skip : all_skips()) {
    Skips skips;
    skips.*skip.member = nothing.*skip.member = false;
    EXPECT_TRUE(same_picture(converge(dataset.points, GetParam(), view, 20'000, {.skips = skips}).picture, expected))
        << skip.name;
  }
  const Converged all = converge(dataset.points, GetParam(), view, 20'000, {.skips = nothing});
  EXPECT_TRUE(same_picture(all.picture, expected));
  EXPECT_EQ(all.points, 200'000u);
}

// Every point is drawn, or hidden, or outside.
TEST_P(HybridRasterizer, WhatIsSkippedIsCounted) {
  const Dataset& dataset = scene("city", 200'000);
  const View view = view_of(dataset, "low", {96, 54});
  const auto count = [&](const Skips& skips) {
    const Converged run = converge(dataset.points, GetParam(), view, 20'000, {.skips = skips});
    EXPECT_EQ(run.points + run.skipped.points_outside + run.skipped.points_hidden, 200'000u);
    EXPECT_EQ(run.skipped.clusters_hidden, run.counts.nodes_occluded);
    EXPECT_EQ(run.skipped.clusters_done + run.skipped.clusters_hidden, run.counts.nodes_visible);
    return run;
  };
  const Converged all = count({});
  EXPECT_GT(all.skipped.clusters_outside, 100u);
  EXPECT_GT(all.skipped.points_outside, 20'000u);
  EXPECT_GT(all.skipped.clusters_hidden, 100u);
  EXPECT_GT(all.skipped.points_hidden, 20'000u);
  EXPECT_GT(all.skipped.points_put_off, 20'000u);
  EXPECT_GT(all.skipped.rounds_joined, 0u);
  EXPECT_EQ(count({.frustum = false}).skipped.points_outside, 0u);
  EXPECT_EQ(count({.occlusion = false}).skipped.clusters_hidden, 0u);
  const Converged by_rounds = count({.rounds = false});
  EXPECT_EQ(by_rounds.skipped.rounds_joined, 0u);
  EXPECT_GT(by_rounds.frames, all.frames);
  // It selects the same in more time
  EXPECT_EQ(count({.done = false}).points, all.points);
}

TEST(HybridSkips, AConvergedViewIsDrawnOnlyWhereItIsNotSkipped) {
  const Dataset& dataset = scene("city", 20'000);
  const View view = view_of(dataset, "oblique", {96, 54});
  for (const bool skip : {true, false}) {
    const auto method =
        make_method(Mode::hybrid, dataset.points, nullptr, {.skips = {.still = false, .converged = skip}});
    ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid);
    while (!renderer.draw(view, 20'000).converged) {
    }
    const FrameData picture = renderer.read();
    const FeedbackTarget* const frame = renderer.frame();
    EXPECT_TRUE(renderer.draw(view, 20'000).converged);
    EXPECT_EQ(renderer.frame() == frame, skip) << "frames take turns";
    EXPECT_TRUE(same_picture(renderer.read(), picture));
  }
}

TEST(HybridBoxes, AConvergedViewHasDrawnOrHiddenEachOfThem) {
  using State = SightedBox::State;
  const Dataset& dataset = scene("city", 200'000);
  const View view = view_of(dataset, "oblique", {96, 54});
  const auto method = make_method(Mode::hybrid, dataset.points, nullptr);
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid);
  const auto count = [&](State state) { return std::ranges::count(method->boxes(), state, &SightedBox::state); };
  renderer.draw(view, 2'000);
  EXPECT_GT(count(State::waiting), 0);
  EXPECT_GT(count(State::streamed), 0);
  while (!renderer.draw(view, 2'000).converged) {
  }
  EXPECT_GT(count(State::complete), 0);
  EXPECT_GT(count(State::occluded), 0);
  EXPECT_EQ(count(State::waiting), 0);
  EXPECT_EQ(count(State::streamed), 0);
}

TEST_P(HybridRasterizer, AStillViewIsKeptOrDrawnAnewWithTheSameFrames) {
  const Dataset& dataset = scene("city", 200'000);
  const auto kept = make_method(Mode::hybrid, dataset.points, nullptr);
  const auto anew = make_method(Mode::hybrid, dataset.points, nullptr, {.skips = {.still = false}});
  ProgressiveRenderer kept_renderer(*kept, GetParam(), dataset.points.grid);
  ProgressiveRenderer anew_renderer(*anew, GetParam(), dataset.points.grid);
  kept_renderer.warm_up({96, 54});
  for (const char* name : {"oblique", "low"}) {
    const View view = view_of(dataset, name, {96, 54});
    std::uint64_t covered = 0;
    for (int frame = 0; frame < 6; ++frame) {
      const FrameReport report = kept_renderer.draw(view, 2'000);
      ASSERT_FALSE(report.converged);
      EXPECT_EQ(report.points_filled, anew_renderer.draw(view, 2'000).points_filled);
      EXPECT_TRUE(same_picture(kept_renderer.read(), anew_renderer.read())) << name << frame;
      if (frame > 0) {
        EXPECT_EQ(kept_renderer.points_reprojected(), 0u);
        EXPECT_EQ(anew_renderer.points_reprojected(), covered);
      }
      covered = kept_renderer.covered_pixels();
    }
  }
}

// Dense shells around the origin, seen from outside, inside and on them: much is hidden, and nothing by much.
PointSet shells(std::mt19937& random) {
  std::normal_distribution<double> normal;
  std::vector<glm::ivec3> positions;
  for (const double radius : {300.0, 320.0, 500.0})
    for (int i = 0; i < 30'000; ++i) {
      const glm::dvec3 direction(normal(random), normal(random), normal(random));
      positions.push_back(glm::ivec3(glm::normalize(direction) * (radius + 4.0 * normal(random))));
    }
  return points_at(positions);
}

TEST_P(HybridRasterizer, RandomViewsChangedMidwayConvergeToBruteForce) {
  std::mt19937 random(20'27);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const PointSet points = shells(random);
  for (const PointSize& point_size : {PointSize(1.0), PointSize(3.0), PointSize(0.5), PointSize(1.0, 0.02)}) {
    if (GetParam() == RasterizerKind::points && point_size.pixels < 1.0) continue;
    const auto method = make_method(Mode::hybrid, points, nullptr);
    ProgressiveRenderer renderer(*method, GetParam(), points.grid, point_size);
    std::uint64_t occluded = 0;
    for (int round = 0; round < 12; ++round) {
      View view = front_view(0.01 * number(1, 200), {number(40, 90), number(30, 60)});
      view.eye += glm::dvec3(0.001 * number(-300, 300), 0.0, 0.001 * number(-300, 300));
      view.eyes_apart = 0.001 * std::max(0, number(-400, 400));
      const auto budget = static_cast<std::uint32_t>(number(3'000, 20'000));
      // Some views are left before they converge
      if (number(0, 2) == 0) {
        for (int frame = 0; frame < 4; ++frame) renderer.draw(view, budget);
        continue;
      }
      std::uint64_t filled = 0;
      for (FrameReport report; !report.converged;) {
        report = renderer.draw(view, budget);
        filled += report.points_filled;
      }
      EXPECT_LE(filled, points.size());
      occluded += method->counts().nodes_occluded;
      for (std::size_t eye = 0; eye < view.eyes(); ++eye)
        ASSERT_TRUE(
            same_picture(renderer.read(eye), brute_force_picture(points, GetParam(), view.of_eye(eye), point_size)))
            << "round " << round << ", point size " << point_size.pixels << ", splat size " << point_size.world
            << ", eye " << eye << " of " << view.eyes();
      EXPECT_EQ(renderer.draw(view, budget).points_filled, 0u);
    }
    EXPECT_GT(occluded, 300u);
  }
}

TEST(Hybrid, RefusesMoreThanTheMemoryAllowed) {
  const PointSet points = random_points(10'000, 500, 3);
  EXPECT_THROW(make_method(Mode::hybrid, points, nullptr, {.limits = {.gpu = 100'000}}), std::runtime_error);
  EXPECT_THROW(make_method(Mode::hybrid, points, nullptr, {.limits = {.main = 100'000}}), std::runtime_error);
}

}  // namespace
}  // namespace stipple::test::render_hybrid
