#include "src/viewer/resolution.h"

#include <gtest/gtest.h>

namespace stipple::test::viewer_resolution {
namespace {

// A machine on which the pixels of a frame of full size take so many milliseconds.
int divisor_after(double ms_at_full, double target_ms, int frames = 200) {
  Resolution resolution;
  for (int i = 0; i < frames; ++i)
    resolution.frame_done(ms_at_full / (resolution.divisor() * resolution.divisor()), target_ms);
  return resolution.divisor();
}

TEST(Resolution, StaysFineWhereThereIsTime) {
  EXPECT_EQ(divisor_after(20.0, 33.0), 1);
}

TEST(Resolution, IsAsCoarseAsItHasToBe) {
  EXPECT_EQ(divisor_after(50.0, 33.0), 2);
  EXPECT_EQ(divisor_after(200.0, 33.0), 3);
  EXPECT_EQ(divisor_after(350.0, 33.0), 4);
  EXPECT_EQ(divisor_after(5000.0, 33.0), Resolution::kCoarsest);
}

TEST(Resolution, GetsThereInAFewFrames) {
  EXPECT_EQ(divisor_after(500.0, 33.0, 6), 4);
}

TEST(Resolution, DoesNotMindOneSlowFrame) {
  Resolution resolution;
  for (int i = 0; i < 100; ++i) resolution.frame_done(i % 10 ? 20.0 : 200.0, 33.0);
  EXPECT_EQ(resolution.divisor(), 1);
}

TEST(Resolution, BecomesFineAgain) {
  Resolution resolution;
  for (int i = 0; i < 20; ++i) resolution.frame_done(100.0, 33.0);
  EXPECT_EQ(resolution.divisor(), Resolution::kCoarsest);
  for (int i = 0; i < 200; ++i) resolution.frame_done(1.0, 33.0);
  EXPECT_EQ(resolution.divisor(), 1);
}

// Whatever pixels take, it settles.
TEST(Resolution, DoesNotGoToAndFro) {
  for (double ms_at_full = 5.0; ms_at_full < 600.0; ms_at_full *= 1.05)
    EXPECT_EQ(divisor_after(ms_at_full, 33.0, 100), divisor_after(ms_at_full, 33.0, 120)) << ms_at_full;
}

}  // namespace
}  // namespace stipple::test::viewer_resolution
