#include "render/reference/reference.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "octree/core/error.h"

namespace stipple::test::measure_reference {
namespace {

// 8 x 8 pixels; looks along +y from the origin so that the plane y = 4 has exactly one unit a pixel: the point
// (x, 4, z) lands at x + 4, 4 - z.
View unit_view() {
  View view;
  view.near = 0.5;
  view.size = {8, 8};
  return view;
}

PointSet points_at(const std::vector<glm::dvec3>& places, double scale = 0.25) {
  PointSet set;
  set.grid.scale = glm::dvec3(scale);
  for (std::size_t i = 0; i < places.size(); ++i)
    set.points.push_back({glm::ivec3(glm::round(places[i] / scale)), 0xFF000000u + static_cast<std::uint32_t>(i)});
  return set;
}

std::size_t at(const FrameData& frame, int x, int y) {
  return static_cast<std::size_t>(y * frame.size.x + x);
}

// All covered pixels as (x, y), row by row.
std::vector<glm::ivec2> covered(const FrameData& frame) {
  std::vector<glm::ivec2> out;
  for (int y = 0; y < frame.size.y; ++y)
    for (int x = 0; x < frame.size.x; ++x)
      if (frame.ids[at(frame, x, y)] != kNoPoint) out.push_back({x, y});
  return out;
}

using Pixels = std::vector<glm::ivec2>;

TEST(Reference, PointLandsOnItsPixelWithAllItCarries) {
  const PointSet set = points_at({{1.25, 4, 2.5}});
  const FrameData frame = render_reference(set, unit_view());
  ASSERT_EQ(covered(frame), (Pixels{{5, 1}}));
  const std::size_t i = at(frame, 5, 1);
  EXPECT_EQ(frame.ids[i], 0u);
  EXPECT_EQ(frame.rgba[i], 0xFF000000u);
  EXPECT_EQ(frame.depth[i], 4.0f);
  EXPECT_EQ(frame.positions[i], glm::ivec3(5, 16, 10));
}

TEST(Reference, PixelsWithoutAPointAreEmpty) {
  const FrameData frame = render_reference(points_at({}), unit_view());
  EXPECT_EQ(frame.covered_pixels(), 0u);
  EXPECT_EQ(frame.ids, std::vector<std::uint32_t>(64, kNoPoint));
  EXPECT_EQ(frame.rgba, std::vector<std::uint32_t>(64, 0));
  EXPECT_EQ(frame.depth, std::vector<float>(64, std::numeric_limits<float>::infinity()));
  EXPECT_EQ(frame.positions, std::vector<glm::ivec3>(64, glm::ivec3(0)));
}

TEST(Reference, LeftAndTopEdgeBelongToThePictureRightAndBottomDoNot) {
  EXPECT_EQ(covered(render_reference(points_at({{-4, 4, 4}}), unit_view())), (Pixels{{0, 0}}));
  EXPECT_TRUE(covered(render_reference(points_at({{4, 4, 0}}), unit_view())).empty());
  EXPECT_TRUE(covered(render_reference(points_at({{0, 4, -4}}), unit_view())).empty());
  EXPECT_EQ(covered(render_reference(points_at({{3.75, 4, -3.75}}), unit_view())), (Pixels{{7, 7}}));
  EXPECT_TRUE(covered(render_reference(points_at({{-4.25, 4, 0}, {0, 4, 4.25}}), unit_view())).empty());
}

TEST(Reference, PointOnABorderBelongsToThePixelRightOfAndBelowIt) {
  EXPECT_EQ(covered(render_reference(points_at({{1, 4, 1}}), unit_view())), (Pixels{{5, 3}}));
}

TEST(Reference, OnlyWhatIsBeyondTheNearPlaneIsDrawn) {
  EXPECT_TRUE(covered(render_reference(points_at({{0, 0.5, 0}}), unit_view())).empty());
  EXPECT_EQ(covered(render_reference(points_at({{0, 0.75, 0}}), unit_view())), (Pixels{{4, 4}}));
  EXPECT_TRUE(
      covered(render_reference(points_at({{0, 0, 0}, {0, -4, 0}, {1, -4, 1}, {3, 0, 0}}), unit_view())).empty());
}

TEST(Reference, NearestPointWins) {
  const FrameData frame = render_reference(points_at({{0, 8, 0}, {0, 4, 0}, {0, 6, 0}}), unit_view());
  EXPECT_EQ(frame.ids[at(frame, 4, 4)], 1u);
}

TEST(Reference, DepthsThatDifferOnlyInDoubleAreToldApart) {
  PointSet set = points_at({{0, 4, 0}, {0, 4, 0}});
  set.grid.scale = glm::dvec3(1e-9);
  set.points[0].position = {0, 2'000'000'001, 0};
  set.points[1].position = {0, 2'000'000'000, 0};
  const FrameData frame = render_reference(set, unit_view());
  EXPECT_EQ(frame.ids[at(frame, 4, 4)], 1u);
}

TEST(Reference, TiesGoToTheLowestIdWhateverTheOrder) {
  PointSet set = points_at({{0, 4, 0}, {0, 4, 0}, {0, 4, 0}});
  set.ids = {5, 3, 9};
  do {
    const FrameData frame = render_reference(set, unit_view());
    EXPECT_EQ(frame.ids[at(frame, 4, 4)], 3u);
  } while (std::next_permutation(set.ids.begin(), set.ids.end()));
}

TEST(Reference, SquareCoversPixelsWhoseCentresLieInIt) {
  // The centre of pixel (4, 4): size 2 takes in the far border of its half-open square, size 3 all around
  EXPECT_EQ(covered(render_reference(points_at({{0.5, 4, -0.5}}), unit_view(), 2.0)),
            (Pixels{{4, 4}, {5, 4}, {4, 5}, {5, 5}}));
  EXPECT_EQ(covered(render_reference(points_at({{0.5, 4, -0.5}}), unit_view(), 3.0)).size(), 9u);
  // The corner between four pixels
  EXPECT_EQ(covered(render_reference(points_at({{0, 4, 0}}), unit_view(), 2.0)),
            (Pixels{{3, 3}, {4, 3}, {3, 4}, {4, 4}}));
  EXPECT_EQ(covered(render_reference(points_at({{0.25, 4, -0.25}}), unit_view(), 3.0)),
            (Pixels{{3, 3}, {4, 3}, {5, 3}, {3, 4}, {4, 4}, {5, 4}, {3, 5}, {4, 5}, {5, 5}}));
}

TEST(Reference, SquareIsCutAtTheBorderAndClippedByItsCentre) {
  EXPECT_EQ(covered(render_reference(points_at({{-3.75, 4, 3.75}}), unit_view(), 3.0)),
            (Pixels{{0, 0}, {1, 0}, {0, 1}, {1, 1}}));
  EXPECT_TRUE(covered(render_reference(points_at({{-4.25, 4, 0}}), unit_view(), 3.0)).empty());
  EXPECT_EQ(covered(render_reference(points_at({{0, 4, 0}}), unit_view(), 1e300)).size(), 64u);
}

TEST(Reference, PointSizeMustBeAboveZero) {
  for (const double size : {0.0, -1.0, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_THROW(render_reference(points_at({}), unit_view(), size), UsageError);
}

TEST(Reference, SpansTheWholeRangeOfPositions) {
  PointSet set;
  const std::int32_t low = std::numeric_limits<std::int32_t>::min();
  const std::int32_t high = std::numeric_limits<std::int32_t>::max();
  set.points.push_back({{high, high, high}, 0xFF000001u});
  set.points.push_back({{low, high, low}, 0xFF000002u});
  set.points.push_back({{low, low, low}, 0xFF000003u});
  // From just behind the low corner differences of positions reach 2^32; the sides are seen half a unit short of 6 and
  // 2
  View view = unit_view();
  view.eye = {-0.5, -2147483649.0, -0.5};
  const FrameData frame = render_reference(set, view);
  ASSERT_EQ(covered(frame), (Pixels{{5, 2}, {2, 5}}));
  EXPECT_EQ(frame.rgba[at(frame, 5, 2)], 0xFF000001u);
  EXPECT_EQ(frame.rgba[at(frame, 2, 5)], 0xFF000002u);
  EXPECT_EQ(frame.depth[at(frame, 5, 2)], 4294967296.0f);
}

TEST(Reference, FarFromTheOriginNothingIsLost) {
  // A georeferenced cloud in millimetres, seen from a metre away: one pixel is a millimetre
  PointSet set;
  set.grid = {{637'000.0, 851'000.0, 400.0}, glm::dvec3(0.001)};
  for (int x = 0; x < 8; ++x) set.points.push_back({{x - 4, 1000, 0}, 0xFF000000u});
  View view = unit_view();
  view.eye = set.grid.offset + glm::dvec3(-0.0005, 0, 0);
  view.cot_x = view.cot_y = 250.0;
  const FrameData frame = render_reference(set, view);
  for (int x = 0; x < 8; ++x) EXPECT_EQ(frame.ids[at(frame, x, 4)], static_cast<std::uint32_t>(x));
}

struct Scene {
  PointSet set;
  View view;
};

// Points in a cube around the eye on a coarse grid, so that many share depth and place; every tenth is not to be drawn.
Scene random_scene(std::size_t count) {
  Scene scene;
  scene.set.grid = {{10.0, -20.0, 5.0}, {0.5, 0.25, 0.5}};
  std::mt19937 random(3);
  for (std::size_t i = 0; i < count; ++i) {
    const auto cell = [&] { return static_cast<std::int32_t>(random() % 200) - 100; };
    const glm::ivec3 position(cell(), cell(), cell());
    scene.set.points.push_back({position, i % 10 == 9 ? 0 : 0xFF000000u | static_cast<std::uint32_t>(random())});
    scene.set.ids.push_back(static_cast<std::uint32_t>(i));
  }
  std::shuffle(scene.set.ids.begin(), scene.set.ids.end(), random);
  scene.view = make_view({{11, -25, 4}, {30, 10, 2}, {0, 0, 1}, 70.0}, {160, 90}, 0.1);
  return scene;
}

// For every point, asks every pixel near it whether its centre lies in the square.
FrameData naive(const Scene& scene, double size) {
  const View& view = scene.view;
  FrameData frame = empty_frame(view.size);
  std::vector<double> depths(frame.pixels(), std::numeric_limits<double>::infinity());
  const glm::dvec3 eye = scene.set.grid.grid_from_world(view.eye);
  for (std::size_t i = 0; i < scene.set.size(); ++i) {
    const PackedPoint& point = scene.set.points[i];
    if (point.rgba >> 24 == 0) continue;
    const glm::dvec3 r = (glm::dvec3(point.position) - eye) * scene.set.grid.scale;
    const double depth = glm::dot(view.forward, r);
    const double x = view.size.x / 2.0 * (1.0 + glm::dot(view.right, r) * view.cot_x / depth);
    const double y = view.size.y / 2.0 * (1.0 - glm::dot(view.up, r) * view.cot_y / depth);
    if (!(depth > view.near && x >= 0 && x < view.size.x && y >= 0 && y < view.size.y)) continue;
    const int reach = static_cast<int>(size) + 1;
    for (int row = static_cast<int>(y) - reach; row <= static_cast<int>(y) + reach; ++row)
      for (int column = static_cast<int>(x) - reach; column <= static_cast<int>(x) + reach; ++column) {
        const glm::dvec2 centre(column + 0.5, row + 0.5);
        if (column < 0 || column >= view.size.x || row < 0 || row >= view.size.y) continue;
        if (!(x - size / 2 < centre.x && centre.x <= x + size / 2)) continue;
        if (!(y - size / 2 < centre.y && centre.y <= y + size / 2)) continue;
        const std::size_t pixel = at(frame, column, row);
        if (depth > depths[pixel] || (depth == depths[pixel] && scene.set.ids[i] > frame.ids[pixel])) continue;
        depths[pixel] = depth;
        frame.ids[pixel] = scene.set.ids[i];
        frame.rgba[pixel] = point.rgba;
        frame.depth[pixel] = static_cast<float>(depth);
        frame.positions[pixel] = point.position;
      }
  }
  return frame;
}

void expect_same(const FrameData& a, const FrameData& b) {
  EXPECT_EQ(a.size, b.size);
  EXPECT_TRUE(a.ids == b.ids);
  EXPECT_TRUE(a.rgba == b.rgba);
  EXPECT_TRUE(a.depth == b.depth);
  EXPECT_TRUE(a.positions == b.positions);
}

TEST(Reference, EqualsANaiveLoopOverRandomPoints) {
  const Scene scene = random_scene(100'000);
  for (const double size : {1.0, 1.5, 2.0, 3.0}) {
    const FrameData expected = naive(scene, size);
    EXPECT_GT(expected.covered_pixels(), 2000u);
    expect_same(render_reference(scene.set, scene.view, size), expected);
  }
}

TEST(Reference, DoesNotDependOnThreadsOrOrder) {
  Scene scene = random_scene(400'000);
  const FrameData expected = render_reference(scene.set, scene.view, 2.0);
  for (const std::size_t threads : {1u, 2u, 7u}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    expect_same(render_reference(scene.set, scene.view, 2.0), expected);
  }
  std::reverse(scene.set.points.begin(), scene.set.points.end());
  std::reverse(scene.set.ids.begin(), scene.set.ids.end());
  expect_same(render_reference(scene.set, scene.view, 2.0), expected);
}

}  // namespace
}  // namespace stipple::test::measure_reference
