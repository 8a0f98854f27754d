#include "src/viewer/resolution.h"

#include <gtest/gtest.h>

namespace stipple::test::viewer_resolution {
namespace {

// A machine on which a frame takes so many milliseconds a million pixels, and nothing else.
int divisor_after(double ms_at_full, double target_ms, int frames = 200) {
  Resolution resolution;
  for (int i = 0; i < frames; ++i)
    resolution.frame_done(ms_at_full / (resolution.divisor() * resolution.divisor()), true, target_ms);
  return resolution.divisor();
}

TEST(Resolution, StaysFineWhereThereIsTime) {
  EXPECT_EQ(divisor_after(20.0, 33.0), 1);
}

TEST(Resolution, IsAsCoarseAsItHasToBe) {
  EXPECT_EQ(divisor_after(50.0, 33.0), 2);
  EXPECT_EQ(divisor_after(200.0, 33.0), 3);
  EXPECT_EQ(divisor_after(500.0, 33.0), 4);
  EXPECT_EQ(divisor_after(5000.0, 33.0), Resolution::kCoarsest);
}

TEST(Resolution, GetsThereInAFewFrames) {
  EXPECT_EQ(divisor_after(500.0, 33.0, 6), 4);
}

TEST(Resolution, DoesNotMindOneSlowFrameNorManyPoints) {
  Resolution resolution;
  for (int i = 0; i < 100; ++i) resolution.frame_done(i % 10 ? 20.0 : 200.0, true, 33.0);
  EXPECT_EQ(resolution.divisor(), 1);
  for (int i = 0; i < 100; ++i) resolution.frame_done(200.0, false, 33.0);
  EXPECT_EQ(resolution.divisor(), 1);
}

TEST(Resolution, BecomesFineAgain) {
  Resolution resolution;
  for (int i = 0; i < 20; ++i) resolution.frame_done(100.0, true, 33.0);
  EXPECT_EQ(resolution.divisor(), Resolution::kCoarsest);
  for (int i = 0; i < 200; ++i) resolution.frame_done(1.0, false, 33.0);
  EXPECT_EQ(resolution.divisor(), 1);
}

}  // namespace
}  // namespace stipple::test::viewer_resolution
