// Near points as round splats: how large they are, and that clusters, carries and tests of what is hidden know it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "octree/core/error.h"
#include "render/method/lod.h"
#include "render/method/progressive_renderer.h"
#include "render/reference/reference.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_splats {
namespace {

class EachRasterizerSplats : public testing::TestWithParam<RasterizerKind> {};
INSTANTIATE_TEST_SUITE_P(Rasterizers, EachRasterizerSplats,
                         testing::Values(RasterizerKind::points, RasterizerKind::compute),
                         [](const auto& param) { return std::string(name_of(param.param)); });

// Far enough from each other that none covers another, at distances of 0.4 to 40.
PointSet scattered_points() {
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < 12; ++i) {
    const double depth = 0.4 * std::pow(1.5, i);
    positions.push_back(glm::ivec3(1000.0 * depth * (0.12 * (i % 4) - 0.17 + 0.0007 * i), 1000.0 * depth,
                                   1000.0 * depth * (0.13 * (i / 4) - 0.11 + 0.0009 * i)));
  }
  return points_at(positions);
}

TEST_P(EachRasterizerSplats, CoverTheDiscsThatTheReferenceCovers) {
  const PointSet points = scattered_points();
  const View view = front_view(0.0001, {640, 360});
  for (const PointSize& point_size : {PointSize(1.0, 0.02), PointSize(1.0, 0.05), PointSize(3.0, 0.03)}) {
    if (GetParam() == RasterizerKind::points && point_size.pixels != 1.0) continue;  // its squares are snapped
    const FrameData frame = brute_force_picture(points, GetParam(), view, point_size);
    EXPECT_TRUE(std::ranges::equal(frame.ids, render_reference(points, view, point_size).ids)) << point_size.world;
    EXPECT_GT(frame.covered_pixels(), 300u);
    for (std::uint32_t id = 0; id < points.size(); ++id) {
      const double diameter = point_size.splat_at_one(view) / (points.points[id].position.y * 0.001 + 0.0001);
      const auto covered = static_cast<double>(std::ranges::count(frame.ids, id));
      if (diameter <= point_size.pixels) {
        EXPECT_EQ(covered, point_size.pixels * point_size.pixels) << id;
      } else if (diameter > 8.0) {
        EXPECT_NEAR(covered, 3.14159 / 4.0 * diameter * diameter, 2.0 * diameter) << id;
      }
    }
  }
}

TEST_P(EachRasterizerSplats, AreNoLargerThanTheLargest) {
  const View view = front_view(1.0, {320, 320});
  const FrameData frame = brute_force_picture(points_at({{0, 0, 0}}), GetParam(), view, PointSize(1.0, 100.0));
  const double area = 3.14159 / 4.0 * PointSize::kLargestSplat * PointSize::kLargestSplat;
  EXPECT_NEAR(static_cast<double>(frame.covered_pixels()), area, 0.01 * area);
}

TEST_P(EachRasterizerSplats, ASplatIsCarriedOnce) {
  const PointSet points = points_at({{-200, 0, 0}, {200, 0, 0}});
  for (const Mode mode : {Mode::hierarchical, Mode::unstructured, Mode::subsample}) {
    Dataset dataset;
    dataset.points = points;
    add_octree(dataset);
    for (const bool by_index : {false, true}) {
      const auto method = make_method(mode, dataset.points, &*dataset.octree, {.carry_indices = by_index});
      ProgressiveRenderer renderer(*method, GetParam(), points.grid, PointSize(1.0, 0.1));
      const View view = front_view(1.0, {160, 90});
      renderer.draw(view, 1);
      renderer.draw(view, 1);
      EXPECT_EQ(renderer.points_reprojected(), 1u) << name_of(mode);
      View closer = view;
      closer.eye.y += 0.1;
      renderer.draw(closer, 1);
      EXPECT_EQ(renderer.points_reprojected(), mode == Mode::subsample ? 0u : 2u) << name_of(mode);
      EXPECT_GT(renderer.covered_pixels(), 50u);
    }
  }
}

TEST_P(EachRasterizerSplats, OverlappingSplatsAreCarriedAboutOnceEach) {
  const PointSet points = random_points(2'000, 500, 5);
  const auto method = make_method(Mode::unstructured, points, nullptr);
  ProgressiveRenderer renderer(*method, GetParam(), points.grid, PointSize(1.0, 0.08));
  const View view = front_view(1.5, {320, 180});
  renderer.draw(view, 1'500);
  const FrameData frame = renderer.read();
  std::vector<std::uint32_t> shown = frame.ids;
  std::ranges::sort(shown);
  const auto repeated = std::unique(shown.begin(), shown.end());
  const auto different = static_cast<std::uint64_t>(repeated - shown.begin());
  renderer.draw(view, 500);
  EXPECT_GE(renderer.points_reprojected(), different - 1);  // one of them is no point
  EXPECT_LE(renderer.points_reprojected(), different * 5 / 4);
  EXPECT_GT(frame.covered_pixels(), 10 * different);
}

TEST_P(EachRasterizerSplats, LodWithABudgetForAllGivesTheBruteForcePicture) {
  const Dataset& dataset = scene("forest", 60'000);
  const View view = view_of(dataset, "low", {160, 90});
  const PointSize point_size(1.0, 0.5);
  const auto method = make_method(Mode::lod, dataset.points, &*dataset.octree);
  EXPECT_TRUE(same_picture(converged_picture(*method, GetParam(), dataset.points.grid, view, 60'000, point_size),
                           brute_force_picture(dataset.points, GetParam(), view, point_size)));
  const SelectionCounts counts = method->counts();
  EXPECT_GT(counts.clusters_far, 0u);
  EXPECT_GT(counts.clusters_across + counts.clusters_near, 0u);
  EXPECT_EQ(counts.clusters_far + counts.clusters_across + counts.clusters_near, counts.nodes_visible);
}

TEST_P(EachRasterizerSplats, SizesThatAreNoneAreRefused) {
  const PointSet points = points_at({{0, 0, 0}});
  const auto method = make_method(Mode::brute_force, points, nullptr);
  for (const double world : {-1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_THROW(ProgressiveRenderer(*method, GetParam(), points.grid, PointSize(1.0, world)), UsageError);
    EXPECT_THROW(render_reference(points, front_view(1.0), PointSize(1.0, world)), UsageError);
  }
}

TEST(SplatRange, IsFarOrNearOnlyWhereAllOfTheBoxIs) {
  const View view = front_view(0.0001, {320, 180});
  const PointSize point_size(1.0, 0.01);
  const double threshold = point_size.splat_at_one(view) - 0.0001;  // of y, as the eye stands before 0
  const auto range = [&](double nearest, double farthest) {
    return splat_range(point_size, view, {glm::dvec3(-0.1, nearest, -0.1), glm::dvec3(0.1, farthest, 0.1)});
  };
  EXPECT_EQ(range(threshold * 1.001, threshold * 2.0), SplatRange::far);
  EXPECT_EQ(range(threshold * 0.5, threshold * 0.998), SplatRange::near);
  EXPECT_EQ(range(threshold * 0.5, threshold * 2.0), SplatRange::across);
  // Nothing is certain at the threshold itself
  EXPECT_EQ(range(threshold * 0.5, threshold), SplatRange::across);
  EXPECT_EQ(range(threshold, threshold * 2.0), SplatRange::across);
  EXPECT_EQ(splat_range(PointSize(2.0), view, {glm::dvec3(-1.0), glm::dvec3(1.0)}), SplatRange::far);
  // Wider squares are overtaken nearer
  EXPECT_EQ(splat_range(PointSize(4.0, 0.01), view,
                        {glm::dvec3(-0.1, threshold * 0.3, -0.1), glm::dvec3(0.1, threshold, 0.1)}),
            SplatRange::far);
}

}  // namespace
}  // namespace stipple::test::render_splats
