// The vertex buffer that is refilled section by section.
#include "render/store/stream_buffer.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/render/gl_test.h"

namespace stipple::test::render_stream_buffer {
namespace {

// The points and ids of a streamed range, read back.
struct Streamed {
  std::vector<PackedPoint> points;
  std::vector<std::uint32_t> ids;
};

Streamed read_back(const PointRange& range) {
  glFinish();
  Streamed out{std::vector<PackedPoint>(range.count), std::vector<std::uint32_t>(range.count)};
  range.points->read(range.first * sizeof(PackedPoint), out.points.data(), range.count * sizeof(PackedPoint));
  range.ids->read(range.first * sizeof(std::uint32_t), out.ids.data(), range.count * sizeof(std::uint32_t));
  return out;
}

PointSet points_with_ids(std::size_t count) {
  PointSet set = random_points(count, 1'000, 1);
  for (std::uint32_t i = 0; i < count; ++i) set.ids.push_back(static_cast<std::uint32_t>(7 * count) - 3 * i);
  return set;
}

// Consecutive points of a set.
struct PointSpan {
  std::uint32_t first;
  std::uint32_t count;
};

PointRange stream(StreamBuffer& buffer, const PointSet& set, const std::vector<PointSpan>& spans) {
  std::vector<PointPiece> pieces;
  for (const PointSpan& span : spans)
    pieces.push_back({.points = set.points.data() + span.first,
                      .ids = set.ids.empty() ? nullptr : set.ids.data() + span.first,
                      .first_id = span.first,
                      .count = span.count});
  return buffer.stream(pieces);
}

void expect_holds(const PointRange& range, const PointSet& set, const std::vector<PointSpan>& spans) {
  const Streamed streamed = read_back(range);
  std::size_t at = 0;
  for (const PointSpan& span : spans)
    for (std::uint32_t i = span.first; i < span.first + span.count; ++i, ++at) {
      ASSERT_LT(at, streamed.ids.size());
      EXPECT_EQ(streamed.points[at].position, set.points[i].position) << at;
      EXPECT_EQ(streamed.points[at].rgba, set.points[i].rgba) << at;
      EXPECT_EQ(streamed.ids[at], set.id(i)) << at;
    }
  EXPECT_EQ(at, streamed.ids.size());
}

TEST(StreamBuffer, HoldsTheSpansOneAfterTheOther) {
  const PointSet set = points_with_ids(1'000);
  StreamBuffer buffer(500);
  const std::vector<PointSpan> spans{{900, 100}, {0, 1}, {17, 0}, {3, 200}, {999, 1}};
  expect_holds(stream(buffer, set, spans), set, spans);
}

TEST(StreamBuffer, PointsWithoutIdsGetTheirPlace) {
  const PointSet set = random_points(100, 1'000, 1);
  StreamBuffer buffer(100);
  const std::vector<PointSpan> spans{{40, 20}, {0, 10}};
  expect_holds(stream(buffer, set, spans), set, spans);
}

TEST(StreamBuffer, AFullSectionFits) {
  const PointSet set = points_with_ids(64);
  StreamBuffer buffer(64);
  const std::vector<PointSpan> all{{0, 64}};
  for (int frame = 0; frame < 5; ++frame) expect_holds(stream(buffer, set, all), set, all);
}

TEST(StreamBuffer, NothingStreamedIsAnEmptyRange) {
  const PointSet set = points_with_ids(10);
  StreamBuffer buffer(10);
  EXPECT_EQ(stream(buffer, set, {}).count, 0u);
}

TEST(StreamBuffer, TheSectionBeforeStaysWhileTheNextIsFilled) {
  const PointSet set = points_with_ids(300);
  StreamBuffer buffer(100);
  const std::vector<PointSpan> first{{0, 100}};
  const std::vector<PointSpan> second{{100, 100}};
  const PointRange before = stream(buffer, set, first);
  const PointRange after = stream(buffer, set, second);
  expect_holds(before, set, first);
  expect_holds(after, set, second);
}

// Mesa's software renderer reads vertices while the draw call is made: there this passes without fences, too.
TEST(StreamBuffer, FramesInFlightShowWhatWasStreamedForThem) {
  constexpr std::uint32_t kFrames = 12;
  constexpr std::uint32_t kPoints = 20'000;
  const PointSet set = random_points(kFrames * kPoints, 900, 3);
  const View view = front_view(3.0, {160, 90});
  for (const RasterizerKind kind : {RasterizerKind::points, RasterizerKind::compute}) {
    StreamBuffer buffer(kPoints);
    const auto rasterizer = make_rasterizer(kind, false);
    ViewUniforms uniforms;
    uniforms.set(make_view_block(view, set.grid, 1.0));
    std::vector<FeedbackTarget> targets;
    for (std::uint32_t f = 0; f < kFrames; ++f) targets.emplace_back(view.size, rasterizer->depth_storage());
    for (std::uint32_t f = 0; f < kFrames; ++f) {
      const PointSpan span{f * kPoints, kPoints};
      const DrawItem item = stream(buffer, set, {span});
      rasterizer->draw(targets[f], {&item, 1});
    }
    for (std::uint32_t f = 0; f < kFrames; ++f) {
      const FrameData frame = targets[f].read(view.near);
      EXPECT_GT(frame.covered_pixels(), 1'000u);
      for (const std::uint32_t id : frame.ids)
        if (id != kNoPoint) {
          ASSERT_EQ(id / kPoints, f) << name_of(kind);
        }
    }
  }
}

}  // namespace
}  // namespace stipple::test::render_stream_buffer
