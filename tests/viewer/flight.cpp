#include "src/viewer/flight.h"

#include <gtest/gtest.h>

namespace stipple::test::viewer_flight {
namespace {

Camera camera_at_x(double x) {
  return {.eye = {x, 0, 10}, .target = {x, 10, 0}};
}

// Moves along x for two seconds, at 60 frames a second.
Flight recorded() {
  Flight flight;
  flight.record(100.0);
  for (int i = 0; i <= 120; ++i) flight.see(camera_at_x(i / 60.0), 100.0 + i / 60.0);
  EXPECT_TRUE(flight.finish());
  return flight;
}

TEST(Flight, FliesAsItWasRecorded) {
  Flight flight = recorded();
  EXPECT_NEAR(flight.path()->duration(), 2.0, 0.11);
  EXPECT_LE(flight.path()->keys.size(), 22u);
  flight.replay(500.0);
  for (double t = 0.0; t < 1.9; t += 0.07) EXPECT_NEAR(flight.camera(500.0 + t).eye.x, t, 0.01);
  EXPECT_TRUE(flight.replays());
}

TEST(Flight, StopsAtTheEnd) {
  Flight flight = recorded();
  flight.replay(0.0);
  EXPECT_EQ(flight.camera(10.0).eye.x, flight.path()->keys.back().camera.eye.x);
  EXPECT_FALSE(flight.replays());
}

TEST(Flight, APauseStaysAPause) {
  Flight flight;
  flight.record(0.0);
  flight.see(camera_at_x(0), 0.0);
  for (double t = 5.0; t < 6.0; t += 0.05) flight.see(camera_at_x(t - 4.95), t);
  ASSERT_TRUE(flight.finish());
  flight.replay(0.0);
  EXPECT_NEAR(flight.camera(3.0).eye.x, 0.0, 1e-9);
}

TEST(Flight, WithoutMovementThereIsNoPath) {
  Flight flight = recorded();
  const std::size_t keys = flight.path()->keys.size();
  flight.record(0.0);
  for (double t = 0.0; t < 3.0; t += 0.1) flight.see(camera_at_x(7), t);
  EXPECT_FALSE(flight.finish());
  EXPECT_EQ(flight.path()->keys.size(), keys);
  Flight none;
  none.replay(0.0);
  EXPECT_FALSE(none.replays());
}

}  // namespace
}  // namespace stipple::test::viewer_flight
