// The cross-section of the "corridor" scene: ballast, embankment or cutting, the land beside.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>

#include "src/scene/model.h"

namespace stipple::scene {

// All in metres, heights over the foot of the ballast, offsets from the middle of the line.
constexpr double kHalfStrip = 30.0;
constexpr double kTrackOffset = 2.2;  // to the middle of either track
constexpr double kGauge = 1.507;      // from the middle of one rail to the other's; 1.435 between their heads
constexpr std::array<double, 4> kRailOffsets{-kTrackOffset - kGauge / 2, -kTrackOffset + kGauge / 2,
                                             kTrackOffset - kGauge / 2, kTrackOffset + kGauge / 2};
constexpr double kRailFoot = 0.5;  // on top of the sleepers
constexpr double kRailHeight = 0.172;

struct TrackSurface {
  double height = 0.0;
  double slope_left = 0.0;  // rise a metre to the left
  glm::vec3 colour{0.0f};
  PointClass point_class = PointClass::ground;
};

// The ground `chainage` metres along the line and `left` of its middle, without rails and plants.
TrackSurface track_surface(double chainage, double left, std::uint32_t salt);

}  // namespace stipple::scene
