#include "render/measure/frame_rates.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <random>

#include "octree/core/error.h"
#include "render/reference/reference.h"

namespace stipple::test::measure_frame_rates {
namespace {

const glm::ivec2 kSize(40, 30);
const Grid kGrid{glm::dvec3(0.0), glm::dvec3(1e-4)};

View view_from(const glm::dvec3& eye) {
  return make_view({.eye = eye, .target = eye + glm::dvec3(0.0, 1.0, 0.0)}, kSize, 1e-3);
}

const View kView = view_from(glm::dvec3(0.0));

// At right angles to the line of sight, with a point for every pixel: the one of pixel i has id first_id + i.
struct Wall {
  double depth;
  std::uint32_t first_id;
};

// Puts into pixel (x, y) the wall's point that is seen at its centre.
void put(FrameData& frame, int x, int y, const Wall& wall) {
  const std::size_t i = static_cast<std::size_t>(y * kSize.x + x);
  const glm::dvec3 r = kView.forward * wall.depth +
                       kView.right * ((2.0 * (x + 0.5) / kSize.x - 1.0) * wall.depth / kView.cot_x) +
                       kView.up * ((1.0 - 2.0 * (y + 0.5) / kSize.y) * wall.depth / kView.cot_y);
  frame.ids[i] = wall.first_id + static_cast<std::uint32_t>(i);
  frame.rgba[i] = 0xFF000000u | static_cast<std::uint32_t>(i);
  frame.depth[i] = static_cast<float>(wall.depth);
  frame.positions[i] = glm::ivec3(glm::round(kGrid.grid_from_world(kView.eye + r)));
}

constexpr Wall kNear{10.0, 0};
constexpr Wall kFar{20.0, 10'000};

FrameData wall_frame(const Wall& wall = kNear) {
  FrameData frame = empty_frame(kSize);
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; ++x) put(frame, x, y, wall);
  return frame;
}

void clear(FrameData& frame, std::size_t i) {
  const FrameData nothing = empty_frame({1, 1});
  frame.ids[i] = nothing.ids[0];
  frame.rgba[i] = nothing.rgba[0];
  frame.depth[i] = nothing.depth[0];
  frame.positions[i] = nothing.positions[0];
}

void copy_pixel(const FrameData& from, std::size_t source, FrameData& to, std::size_t i) {
  to.ids[i] = from.ids[source];
  to.rgba[i] = from.rgba[source];
  to.depth[i] = from.depth[source];
  to.positions[i] = from.positions[source];
}

// Every pixel shows what its neighbour on the left should.
FrameData shifted(const FrameData& frame, int pixels) {
  FrameData out = frame;
  for (int y = 0; y < kSize.y; ++y)
    for (int x = pixels; x < kSize.x; ++x)
      copy_pixel(frame, static_cast<std::size_t>(y * kSize.x + x - pixels), out,
                 static_cast<std::size_t>(y * kSize.x + x));
  return out;
}

void expect_only(const FrameRates& rates, const char* name, double expected) {
  EXPECT_NEAR(rates.hole, name == std::string("hole") ? expected : 0.0, 1e-12) << name;
  EXPECT_NEAR(rates.ghost, name == std::string("ghost") ? expected : 0.0, 1e-12) << name;
  EXPECT_NEAR(rates.see_through, name == std::string("see_through") ? expected : 0.0, 1e-12) << name;
  EXPECT_NEAR(rates.wrong_point, name == std::string("wrong_point") ? expected : 0.0, 1e-12) << name;
}

FrameRates rates_of(const FrameData& test, const FrameData& reference) {
  return frame_rates(test, reference, kView, kGrid);
}

TEST(FrameRates, AreZeroForTheReferenceItself) {
  const FrameRates rates = rates_of(wall_frame(), wall_frame());
  expect_only(rates, "none", 0.0);
  EXPECT_EQ(rates.covered_pixels, 1200u);
  EXPECT_EQ(rates.depth_error_mean, 0.0);
  EXPECT_EQ(rates.depth_error_p95, 0.0);
}

TEST(FrameRates, HolesRaiseTheHoleRateAlone) {
  FrameData test = wall_frame();
  for (std::size_t i = 0; i < test.pixels(); i += 4) clear(test, i);
  const FrameRates rates = rates_of(test, wall_frame());
  expect_only(rates, "hole", 0.25);
  EXPECT_EQ(rates.depth_error_mean, 0.0);
}

TEST(FrameRates, APictureShiftedByAPixelRaisesTheWrongPointRateAlone) {
  const FrameRates rates = rates_of(shifted(wall_frame(), 1), wall_frame());
  expect_only(rates, "wrong_point", 39.0 / 40.0);
  EXPECT_EQ(rates.depth_error_mean, 0.0);
}

TEST(FrameRates, TheFarWallSeenThroughTheNearOneRaisesTheSeeThroughRateAlone) {
  FrameData test = wall_frame();
  for (int y = 0; y < kSize.y; ++y)
    for (int x = 0; x < kSize.x; x += 5) put(test, x, y, kFar);
  const FrameRates rates = rates_of(test, wall_frame());
  expect_only(rates, "see_through", 0.2);
  EXPECT_NEAR(rates.depth_error_mean, 0.2 * 1.0, 1e-9);
  EXPECT_NEAR(rates.depth_error_p95, 1.0, 1e-9);
}

TEST(FrameRates, AStaleFrameRaisesTheGhostRateAlone) {
  // A unit to the side is 2.6 pixels on a wall at distance 10
  const FrameData before = wall_frame();
  for (const double step : {2.0, -4.0}) {
    const View now = view_from({step, 0.0, 0.0});
    FrameData reference = empty_frame(kSize);
    for (std::size_t i = 0; i < reference.pixels(); ++i) {
      copy_pixel(before, i, reference, i);
      reference.ids[i] += 50'000;
      reference.positions[i].x += static_cast<int>(std::lround(step / kGrid.scale.x));
    }
    expect_only(frame_rates(before, reference, now, kGrid), "ghost", 1.0);
  }
}

TEST(FrameRates, WhatIsShownWhereNothingIsIsAGhost) {
  FrameData reference = wall_frame();
  for (std::size_t i = 0; i < reference.pixels(); i += 3) clear(reference, i);
  const FrameRates rates = rates_of(wall_frame(), reference);
  expect_only(rates, "ghost", 1.0 / 3.0);
  EXPECT_EQ(rates.covered_pixels, 1200u);
}

TEST(FrameRates, WhatStandsBeforeTheNearestPointIsAGhost) {
  expect_only(rates_of(wall_frame(kNear), wall_frame(kFar)), "ghost", 1.0);
}

TEST(FrameRates, AnOldDepthIsAGhostThoughIdAndPlaceAreRight) {
  FrameData test = wall_frame();
  for (float& depth : test.depth) depth *= 1.05f;
  expect_only(rates_of(test, wall_frame()), "ghost", 1.0);
}

TEST(FrameRates, AnotherPointAtAlmostTheSameDepthIsAWrongPoint) {
  for (const double depth : {9.95, 10.0, 10.05})
    expect_only(rates_of(wall_frame({depth, 77'000}), wall_frame()), "wrong_point", 1.0);
}

TEST(FrameRates, PixelsThatNeitherCoversDoNotCount) {
  FrameData test = empty_frame(kSize);
  FrameData reference = empty_frame(kSize);
  EXPECT_EQ(rates_of(test, reference).covered_pixels, 0u);
  expect_only(rates_of(test, reference), "none", 0.0);
  put(reference, 3, 3, kNear);
  put(reference, 4, 3, kNear);
  put(test, 4, 3, kNear);
  expect_only(rates_of(test, reference), "hole", 0.5);
}

TEST(FrameRates, LargePointsMayLieFartherFromThePixelsTheyCover) {
  const FrameData test = shifted(wall_frame(), 3);
  EXPECT_GT(rates_of(test, wall_frame()).ghost, 0.9);
  EXPECT_EQ(frame_rates(test, wall_frame(), kView, kGrid, 5.0).ghost, 0.0);
}

// Any mixture: the shares are those of disjoint sets of pixels, and what remains is right.
TEST(FrameRates, AreDisjointAndDoNotDependOnTheNumberOfThreads) {
  std::mt19937 random(5);
  for (int round = 0; round < 50; ++round) {
    FrameData test = wall_frame();
    FrameData reference = wall_frame();
    std::uint64_t right = 0;
    for (int y = 0; y < kSize.y; ++y)
      for (int x = 0; x < kSize.x; ++x) {
        const std::size_t i = static_cast<std::size_t>(y * kSize.x + x);
        for (FrameData* frame : {&test, &reference}) {
          if (random() % 4 == 0) clear(*frame, i);
          if (random() % 4 == 0) put(*frame, x, y, kFar);
        }
        right += test.ids[i] == reference.ids[i] && test.ids[i] != kNoPoint ? 1u : 0u;
      }
    const FrameRates all = rates_of(test, reference);
    EXPECT_NEAR(all.hole + all.ghost + all.see_through + all.wrong_point,
                1.0 - static_cast<double>(right) / static_cast<double>(all.covered_pixels), 1e-12);
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    const FrameRates alone = rates_of(test, reference);
    EXPECT_EQ(all.hole, alone.hole);
    EXPECT_EQ(all.ghost, alone.ghost);
    EXPECT_EQ(all.depth_error_mean, alone.depth_error_mean);
    EXPECT_EQ(all.depth_error_p95, alone.depth_error_p95);
  }
}

// Points anywhere, drawn by the real renderer: a subset of them may leave holes, show others behind or beside, but
// never a ghost.
TEST(FrameRates, AFrameOfSomeOfThePointsHasNoGhosts) {
  std::mt19937 random(9);
  const auto made_set = [&](std::uint32_t share) {
    PointSet set;
    set.grid = kGrid;
    std::mt19937 place(3);
    for (std::uint32_t i = 0; i < 20'000; ++i) {
      const auto coordinate = [&](int low, int high) {
        return static_cast<int>(place() % static_cast<std::uint32_t>(high - low)) + low;
      };
      const glm::ivec3 position(coordinate(-80'000, 80'000), coordinate(50'000, 200'000), coordinate(-60'000, 60'000));
      if (i % share != 0) continue;
      set.points.push_back({position, 0xFF808080u});
      set.ids.push_back(i);
      set.bounds.extend(position);
    }
    return set;
  };
  for (const double point_size : {1.0, 3.0}) {
    const FrameData reference = render_reference(made_set(1), kView, point_size);
    const FrameRates rates =
        frame_rates(render_reference(made_set(7), kView, point_size), reference, kView, kGrid, point_size);
    EXPECT_EQ(rates.ghost, 0.0);
    EXPECT_GT(rates.see_through, 0.05);
  }
}

TEST(FrameRates, FramesOfDifferentSizesCannotBeCompared) {
  EXPECT_THROW(rates_of(wall_frame(), empty_frame({30, 40})), Error);
}

}  // namespace
}  // namespace stipple::test::measure_frame_rates
