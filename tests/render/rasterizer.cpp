// Both rasterizers against each other, themselves and the reference.
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>

#include "render/method/brute_force.h"
#include "render/method/progressive_renderer.h"
#include "render/raster/compute_rasterizer.h"
#include "render/reference/reference.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_rasterizer {
namespace {

class EachRasterizer : public testing::TestWithParam<RasterizerKind> {
 protected:
  FrameData draw(const PointSet& points, const View& view, double point_size = 1.0) const {
    return brute_force_picture(points, GetParam(), view, point_size);
  }
};
INSTANTIATE_TEST_SUITE_P(Rasterizers, EachRasterizer, testing::Values(RasterizerKind::points, RasterizerKind::compute),
                         [](const auto& param) { return std::string(name_of(param.param)); });

// The same points in another order, keeping their ids.
PointSet in_other_order(const PointSet& points, std::uint32_t seed) {
  std::vector<std::uint32_t> order(points.size());
  std::iota(order.begin(), order.end(), 0u);
  std::shuffle(order.begin(), order.end(), std::mt19937(seed));
  PointSet shuffled = points;
  shuffled.ids.assign(order.begin(), order.end());
  for (std::size_t i = 0; i < order.size(); ++i) shuffled.points[i] = points.points[order[i]];
  return shuffled;
}

TEST_P(EachRasterizer, DrawsAPointWhereTheReferenceDoes) {
  const PointSet points = points_at({{500, 0, 250}});
  const View view = front_view(2.0);
  const FrameData frame = draw(points, view);
  EXPECT_EQ(frame.covered_pixels(), 1u);
  EXPECT_TRUE(std::ranges::equal(frame.ids, render_reference(points, view).ids));
}

TEST_P(EachRasterizer, NearestPointWinsThePixel) {
  const PointSet points = points_at({{6, 100, 6}, {6, -100, 6}, {6, 0, 6}});
  const FrameData frame = draw(points, front_view(2.0));
  EXPECT_EQ(frame.covered_pixels(), 1u);
  EXPECT_EQ(frame.ids[static_cast<std::size_t>(89 * 320 + 160)], 1u);
}

TEST_P(EachRasterizer, PointZeroIsAPoint) {
  const FrameData frame = draw(points_at({{0, 0, 0}}), front_view(2.0));
  EXPECT_EQ(std::ranges::count(frame.ids, 0u), 1);
}

TEST_P(EachRasterizer, NothingBehindTheEyeOrBeforeTheNearPlaneIsDrawn) {
  const PointSet points = points_at({{0, -2001, 0}, {0, -3000, 0}, {0, -2000, 0}});
  EXPECT_EQ(draw(points, front_view(2.0)).covered_pixels(), 0u);
}

TEST_P(EachRasterizer, TheOrderOfDrawingChangesNothing) {
  const PointSet points = random_points(60'000, 700, 1);
  const View view = front_view(3.0);
  const FrameData expected = draw(points, view);
  for (std::uint32_t seed = 1; seed <= 3; ++seed)
    EXPECT_TRUE(same_picture(draw(in_other_order(points, seed), view), expected));
}

TEST_P(EachRasterizer, TheOrderOfDrawingChangesNothingWithSplats) {
  const PointSet points = random_points(5'000, 700, 2);
  const View view = front_view(3.0);
  const FrameData expected = draw(points, view, 3.0);
  EXPECT_TRUE(same_picture(draw(in_other_order(points, 1), view, 3.0), expected));
}

TEST_P(EachRasterizer, TiesGoToTheLowestIdEvenWhenThereAreMoreThanNotes) {
  // 200,000 points in four places, highest ids first: every arrival improves on the one before
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < 200'000; ++i) positions.push_back({(i % 4) * 100, 0, 0});
  PointSet points = points_at(positions);
  points.ids.resize(points.size());
  for (std::size_t i = 0; i < points.size(); ++i) points.ids[i] = static_cast<std::uint32_t>(points.size() - 1 - i);
  const FrameData frame = draw(points, front_view(2.0));
  ASSERT_EQ(frame.covered_pixels(), 4u);
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (frame.ids[i] == kNoPoint) continue;
    EXPECT_LT(frame.ids[i], 4u);
    const PackedPoint& winner = points.points[points.size() - 1 - frame.ids[i]];
    EXPECT_EQ(frame.positions[i], winner.position);
    EXPECT_EQ(frame.rgba[i], winner.rgba);
  }
}

// Part after part of the points, each added to the picture of those before.
FrameData draw_in_parts(const PointSet& points, Rasterizer& rasterizer, const View& view, std::uint32_t parts,
                        double point_size) {
  GpuBuffer all(points.size() * sizeof(PackedPoint));
  all.write(0, std::span<const PackedPoint>(points.points));
  GpuBuffer ids(points.size() * sizeof(std::uint32_t));
  ids.write(0, std::span<const std::uint32_t>(points.ids));
  FeedbackTarget target(view.size, rasterizer.depth_storage());
  ViewUniforms uniforms;
  uniforms.set(make_view_block(view, points.grid, point_size));
  const auto size = static_cast<std::uint32_t>(points.size());
  for (std::uint32_t part = 0; part < parts; ++part) {
    const std::uint32_t first = size / parts * part;
    const std::uint32_t end = part + 1 == parts ? size : first + size / parts;
    const DrawItem item = PointRange{.points = &all,
                                     .ids = points.ids.empty() ? nullptr : &ids,
                                     .first = first,
                                     .count = end - first,
                                     .first_id = first};
    rasterizer.add(target, {&item, 1});
  }
  return target.read(view.near);
}

TEST_P(EachRasterizer, PartsAddUpToThePictureOfAll) {
  const View view = front_view(3.0);
  for (const double point_size : {1.0, 3.0}) {
    const PointSet points = in_other_order(random_points(20'000, 700, 3), 5);
    const auto rasterizer = make_rasterizer(GetParam(), point_size != 1.0);
    EXPECT_TRUE(same_picture(draw_in_parts(points, *rasterizer, view, 7, point_size), draw(points, view, point_size)));
  }
}

// 4,000 points in 200 places of two depths.
PointSet many_ties() {
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < 4'000; ++i) positions.push_back({(i * 37) % 400, 100 * (i % 2), 0});
  return in_other_order(points_at(positions), 6);
}

TEST_P(EachRasterizer, PartsOfEqualDepthAddUpToThePictureOfAll) {
  const PointSet points = many_ties();
  const View view = front_view(2.0);
  const auto rasterizer = make_rasterizer(GetParam(), false);
  EXPECT_TRUE(same_picture(draw_in_parts(points, *rasterizer, view, 9, 1.0), draw(points, view)));
}

TEST_P(EachRasterizer, SplatsCoverTheirSquare) {
  EXPECT_EQ(draw(points_at({{0, 0, 0}}), front_view(2.0), 4.0).covered_pixels(), 16u);
}

TEST_P(EachRasterizer, PositionsAtTheEndsOfInt32AreDrawnWhereTheyAre) {
  constexpr int kLow = std::numeric_limits<int>::min();
  constexpr int kHigh = std::numeric_limits<int>::max();
  const PointSet points =
      points_at({{kLow, kHigh, kLow}, {kHigh, kHigh, kHigh}, {kLow, kHigh, kHigh}, {777'777, kHigh, 777'777}});
  // The eye at the lower end: the differences take 33 bits
  const Camera camera{.eye = {1234.5, -2.2e6, 987.6}, .target = {0.0, 0.0, 0.0}, .fov_deg = 100};
  const View view = make_view(camera, {320, 320}, 0.001);
  const FrameData frame = draw(points, view);
  EXPECT_EQ(frame.covered_pixels(), 4u);
  EXPECT_TRUE(std::ranges::equal(frame.ids, render_reference(points, view).ids));
}

// Whether the place of point `id`, computed in double precision, is outside of the pixel or so near its border that
// single precision may have seen it outside.
bool may_be_next_door(const PointSet& by_id, const View& view, std::uint32_t id, int x, int y) {
  constexpr double kMargin = 1e-3;
  if (id == kNoPoint) return false;
  const glm::dvec3 r = by_id.grid.world_from_grid(by_id.points[id].position) - view.eye;
  const double depth = glm::dot(view.forward, r);
  const double px = 0.5 * view.size.x * (1.0 + glm::dot(view.right, r) * view.cot_x / depth);
  const double py = 0.5 * view.size.y * (1.0 - glm::dot(view.up, r) * view.cot_y / depth);
  return px < x + kMargin || px > x + 1 - kMargin || py < y + kMargin || py > y + 1 - kMargin;
}

void expect_draws_as_in_two_passes(bool keys, std::size_t batch) {
  const View view = front_view(2.0);
  const PointSet random = random_points(20'000, 700, 3);
  for (const PointSet& points : {random, in_other_order(random, 5), many_ties()}) {
    for (const double point_size : {1.0, 3.0}) {
      ComputeRasterizer two_passes(point_size != 1.0, false);
      ComputeRasterizer other(point_size != 1.0, keys, batch);
      for (const std::uint32_t parts : {1u, 7u})
        EXPECT_TRUE(same_picture(draw_in_parts(points, other, view, parts, point_size),
                                 draw_in_parts(points, two_passes, view, 1, point_size)));
    }
  }
}

TEST(ComputeRasterizer, SmallBatchesChangeNothing) {
  expect_draws_as_in_two_passes(false, 1000);
}

// Mesa's software renderer has these when it is told to (tests/CMakeLists.txt).
TEST(ComputeRasterizer, SixtyFourBitAtomicsChangeNothing) {
  if (!has_64_bit_atomics()) GTEST_SKIP() << "this driver has no 64-bit atomics";
  expect_draws_as_in_two_passes(true, ComputeRasterizer::kBatch);
  expect_draws_as_in_two_passes(true, 1000);
}

TEST(ComputeRasterizer, DiffersFromTheReferenceInAThousandthOfThePixelsAndOnlyByRounding) {
  for (const char* name : {"city", "terrain", "forest", "interior", "corridor"}) {
    const Dataset& dataset = scene(name, 300'000);
    const View view = view_of(dataset, "oblique", {640, 360});
    const FrameData frame = brute_force_picture(dataset.points, RasterizerKind::compute, view);
    const FrameData reference = render_reference(dataset.points, view);
    PointSet by_id = dataset.points;
    for (std::size_t i = 0; i < by_id.size(); ++i) by_id.points[dataset.points.id(i)] = dataset.points.points[i];

    std::size_t different = 0;
    for (std::size_t i = 0; i < frame.pixels(); ++i) {
      if (frame.ids[i] == reference.ids[i]) continue;
      ++different;
      const int x = static_cast<int>(i) % view.size.x;
      const int y = static_cast<int>(i) / view.size.x;
      const bool same_depth = std::abs(frame.depth[i] - reference.depth[i]) <= 1e-6f * reference.depth[i];
      EXPECT_TRUE(same_depth || may_be_next_door(by_id, view, frame.ids[i], x, y) ||
                  may_be_next_door(by_id, view, reference.ids[i], x, y))
          << name << " pixel " << x << "," << y;
    }
    EXPECT_LE(static_cast<double>(different), 0.001 * static_cast<double>(frame.pixels())) << name;
    std::printf("%s: %zu of %zu pixels differ\n", name, different, frame.pixels());
  }
}

}  // namespace
}  // namespace stipple::test::render_rasterizer
