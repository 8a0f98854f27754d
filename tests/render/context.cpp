// Pictures do not depend on the circumstances they are drawn in: size, magnitude of the coordinates, and whoever else
// uses the OpenGL context.
#include <gtest/gtest.h>

#include <cmath>

#include "octree/build/builder.h"
#include "octree/core/error.h"
#include "render/method/brute_force.h"
#include "render/method/progressive_renderer.h"
#include "render/reference/reference.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_context {
namespace {

constexpr RasterizerKind kRasterizers[] = {RasterizerKind::points, RasterizerKind::compute};

class EachRasterizerAnywhere : public testing::TestWithParam<RasterizerKind> {};
INSTANTIATE_TEST_SUITE_P(Rasterizers, EachRasterizerAnywhere, testing::ValuesIn(kRasterizers),
                         [](const auto& param) { return std::string(name_of(param.param)); });

TEST_P(EachRasterizerAnywhere, AllMethodsConvergeToBruteForceAtOddSizes) {
  const Dataset& dataset = scene("city", 60'000);
  for (const glm::ivec2 size : {glm::ivec2(1, 1), {17, 3}, {3, 200}, {1281, 719}}) {
    const View view = view_of(dataset, "oblique", size);
    const FrameData expected = brute_force_picture(dataset.points, GetParam(), view);
    EXPECT_GT(expected.covered_pixels(), 0u);
    for (const Mode mode : {Mode::hierarchical, Mode::unstructured}) {
      const auto method = make_method(mode, dataset.points, &*dataset.octree);
      EXPECT_TRUE(same_picture(converged_picture(*method, GetParam(), dataset.points.grid, view, 25'000), expected))
          << size.x << "x" << size.y << " " << name_of(mode);
    }
  }
}

TEST_P(EachRasterizerAnywhere, ChangingTheSizeOnTheWayChangesNothing) {
  const Dataset& dataset = scene("city", 60'000);
  for (const Mode mode : {Mode::hierarchical, Mode::unstructured}) {
    const auto method = make_method(mode, dataset.points, &*dataset.octree);
    ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid);
    for (const glm::ivec2 size : {glm::ivec2(40, 30), {200, 100}, {13, 77}})
      for (int frame = 0; frame < 2; ++frame) renderer.draw(view_of(dataset, "oblique", size), 5'000);
    const View view = view_of(dataset, "low", {161, 89});
    while (!renderer.draw(view, 25'000).converged) {
    }
    EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, GetParam(), view)));
  }
}

// On a grid of 1/256 units, so that shifts by whole units are exact however large.
PointSet points_on_dyadic_grid() {
  PointSet set = random_points(20'000, 3'000, 8);
  set.grid.scale = glm::dvec3(1.0 / 256.0);
  return set;
}

View dyadic_view(const glm::dvec3& shift) {
  return make_view({.eye = shift + glm::dvec3(3.25, -20.5, 7.125), .target = shift}, {200, 150}, 1.0 / 256.0);
}

void expect_same_ids_colours_and_depths(const FrameData& a, const FrameData& b) {
  ASSERT_GT(a.covered_pixels(), 1'000u);
  EXPECT_EQ(a.ids, b.ids);
  EXPECT_EQ(a.rgba, b.rgba);
  EXPECT_EQ(a.depth, b.depth);
}

const glm::dvec3 kUtm(5e5, 5.3e6, 100.0);

TEST_P(EachRasterizerAnywhere, AnOffsetOfUtmMagnitudeChangesNothing) {
  const PointSet near = points_on_dyadic_grid();
  PointSet far = near;
  far.grid.offset = kUtm;
  expect_same_ids_colours_and_depths(brute_force_picture(near, GetParam(), dyadic_view(glm::dvec3(0))),
                                     brute_force_picture(far, GetParam(), dyadic_view(kUtm)));
}

TEST_P(EachRasterizerAnywhere, IntegerPositionsOfUtmMagnitudeChangeNothing) {
  const PointSet near = points_on_dyadic_grid();
  PointSet far = near;
  const glm::ivec3 cells(kUtm * 256.0);
  far.bounds = {};
  for (PackedPoint& point : far.points) {
    point.position += cells;
    far.bounds.extend(point.position);
  }
  expect_same_ids_colours_and_depths(brute_force_picture(near, GetParam(), dyadic_view(glm::dvec3(0))),
                                     brute_force_picture(far, GetParam(), dyadic_view(kUtm)));
}

TEST_P(EachRasterizerAnywhere, MethodsConvergeAtUtmMagnitudeOnAMillimetreGrid) {
  PointSet set = random_points(5'000, 4'000, 9);
  set.grid.offset = kUtm + 0.123;
  const Octree octree = build_octree(set.grid, set.bounds,
                                     PositionView(std::span<const PackedPoint>(set.points), &PackedPoint::position));
  PointSet ordered = set;
  for (std::size_t i = 0; i < set.size(); ++i) ordered.points[i] = set.points[octree.order[i]];
  ordered.ids = octree.order;
  const Camera camera{.eye = set.grid.offset + glm::dvec3(1.1, -3.3, 0.7), .target = set.grid.offset};
  const View view = make_view(camera, {120, 90}, 0.001);
  const FrameData expected = brute_force_picture(set, GetParam(), view);
  ASSERT_GT(expected.covered_pixels(), 1'000u);
  for (const Mode mode : {Mode::hierarchical, Mode::unstructured})
    EXPECT_TRUE(same_picture(converged_picture(*make_method(mode, ordered, &octree), GetParam(), set.grid, view, 900),
                             expected))
        << name_of(mode);
}

TEST_P(EachRasterizerAnywhere, PointsAreClippedByTheirCentreHoweverLarge) {
  // Beyond the right and the upper edge by less than half a point's size
  const View view = front_view(2.0, {100, 100});
  const double edge = 2.0 * std::tan(glm::radians(30.0)) * 1'000.0;
  const auto outside = static_cast<int>(edge * 1.02);
  EXPECT_EQ(brute_force_picture(points_at({{outside, 0, 0}, {0, 0, outside}}), GetParam(), view, 9.0).covered_pixels(),
            0u);
  // At x 98.5, y 50.5
  const glm::ivec3 inside(edge * 0.97, 0, -edge * 0.01);
  EXPECT_EQ(brute_force_picture(points_at({inside}), GetParam(), view, 9.0).covered_pixels(), 6u * 9u);
}

TEST_P(EachRasterizerAnywhere, ARendererBesideAnotherIsNotDisturbed) {
  const Dataset& dataset = scene("city", 60'000);
  const View view = view_of(dataset, "oblique", {161, 89});
  const View other_view = view_of(dataset, "low", {60, 40});
  for (const RasterizerKind other : kRasterizers) {
    const auto method = make_method(Mode::hierarchical, dataset.points, &*dataset.octree);
    const auto other_method = make_method(Mode::unstructured, dataset.points, nullptr);
    ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid);
    ProgressiveRenderer beside(*other_method, other, dataset.points.grid, 3.0);
    for (bool done = false; !done;) {
      beside.draw(other_view, 9'000);
      done = renderer.draw(view, 9'000).converged;
      beside.covered_pixels();
    }
    EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, GetParam(), view)));
  }
}

TEST_P(EachRasterizerAnywhere, LeavesNoErrorBehind) {
  brute_force_picture(random_points(100, 500, 1), GetParam(), front_view(2.0, {16, 9}), 2.0);
  EXPECT_EQ(glGetError(), static_cast<GLenum>(GL_NO_ERROR));
}

TEST(Rasterizers, PointSizesThatAreNotDrawnAreWrongUsage) {
  const PointSet points = points_at({{0, 0, 0}});
  BruteForce method(points);
  for (const RasterizerKind kind : kRasterizers) {
    for (const double point_size : {0.0, -1.0, std::nan(""), 1e30, 1e5})
      EXPECT_THROW(ProgressiveRenderer(method, kind, points.grid, point_size), UsageError) << point_size;
    EXPECT_NO_THROW(ProgressiveRenderer(method, kind, points.grid, 64.0));
  }
  EXPECT_THROW(ProgressiveRenderer(method, RasterizerKind::points, points.grid, 0.01), UsageError);
}

TEST(Rasterizers, TheLargestPointIsDrawnWhole) {
  const PointSet points = points_at({{0, 0, 0}});
  const View view = front_view(2.0, {300, 300});
  EXPECT_EQ(brute_force_picture(points, RasterizerKind::compute, view, 255.0).covered_pixels(), 255u * 255u);
}

TEST(Rasterizers, SplatsCoverThePixelsThatTheReferenceCovers) {
  const PointSet points = random_points(300, 700, 5);
  const View view = front_view(3.0, {160, 120});
  for (const double point_size : {0.5, 1.5, 2.0, 3.0, 9.0}) {
    const FrameData reference = render_reference(points, view, point_size);
    const FrameData frame = brute_force_picture(points, RasterizerKind::compute, view, point_size);
    std::size_t different = 0;
    for (std::size_t i = 0; i < frame.pixels(); ++i) different += frame.ids[i] != reference.ids[i];
    EXPECT_LE(different, reference.covered_pixels() / 100) << point_size;
  }
}

}  // namespace
}  // namespace stipple::test::render_context
