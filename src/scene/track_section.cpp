#include "src/scene/track_section.h"

#include <algorithm>
#include <cmath>

#include "src/scene/noise.h"
#include "src/scene/texture.h"

namespace stipple::scene {
namespace {

constexpr double kBallastTop = 3.9;  // half its width
constexpr double kBallastFoot = 4.7;
constexpr double kShoulder = 6.3;      // where the embankment begins to fall
constexpr double kBatter = 1.0 / 1.6;  // its slope
constexpr double kSleeperSpacing = 0.6;

// Smooth cross-section over a land that lies `land` higher than the foot of the ballast.
double profile(double away, double land) {
  if (away < kBallastTop) return kRailFoot;
  if (away < kBallastFoot) return kRailFoot * (kBallastFoot - away) / (kBallastFoot - kBallastTop);
  if (away < kShoulder) return 0.0;
  // A ditch of 60 cm at the foot of a cutting
  const double run = away - kShoulder;
  if (land > 0) {
    if (run < 1.8) return -0.6 * (1 - std::abs(run / 0.9 - 1));
    return std::min(land, kBatter * (run - 1.8));
  }
  return std::max(land, -kBatter * run);
}

glm::vec3 ballast_colour(double chainage, double left, std::uint32_t salt) {
  const float stone = value_noise(chainage * 16.0, left * 16.0, salt + 1);
  const float tone = fractal_noise(chainage / 3.0, left / 3.0, 3, salt + 2);
  // Rust and brake dust along the rails
  double rail = 1.0;
  for (const double offset : kRailOffsets) rail = std::min(rail, std::abs(left - offset));
  const auto rusty = static_cast<float>(smooth_step(0.5, 0.0, rail));
  return glm::mix(glm::vec3(0.42f, 0.38f, 0.34f), glm::vec3(0.4f, 0.29f, 0.2f), 0.7f * rusty) *
         (0.35f + 0.7f * stone + 0.4f * tone);
}

}  // namespace

TrackSurface track_surface(double chainage, double left, std::uint32_t salt) {
  const double away = std::abs(left);
  const double side = left < 0 ? -1.0 : 1.0;
  const double along_land = chainage / 260.0;
  const double land = 9.0 * (fractal_noise(along_land, 4.0 * side, 3, salt + 10) - 0.52) +
                      1.6 * (value_noise(chainage / 22.0, left / 14.0, salt + 13) - 0.5);
  TrackSurface surface;
  surface.height = profile(away, land);
  surface.slope_left = side * (profile(away + 0.05, land) - profile(away - 0.05, land)) / 0.1;

  const double from_track = std::abs(away - kTrackOffset);
  if (away < kBallastFoot) {
    const double place = chainage / kSleeperSpacing;
    const double from_sleeper = std::abs(fraction_of(place) - 0.5) * kSleeperSpacing;
    if (from_track < 1.3 && from_sleeper < 0.13) {
      const float stain = fractal_noise(chainage * 4.0, left * 4.0, 4, salt + 20);
      surface.colour = glm::vec3(0.74f, 0.72f, 0.67f) * (0.6f + 0.6f * stain);
      surface.point_class = PointClass::rail;
    } else {
      surface.height += 0.07 * (value_noise(chainage * 16.0, left * 16.0, salt + 1) - 1.0);
      surface.colour = ballast_colour(chainage, left, salt);
    }
    return surface;
  }

  // A cable duct beside the ballast, then grass on the slopes, fields and a gravel road beyond
  if (std::abs(away - 5.9) < 0.2) {
    surface.height += 0.12;
    surface.colour = paving(chainage, left, 1.0, {0.66f, 0.65f, 0.62f}, salt + 30);
    return surface;
  }
  const float gravel = fractal_noise(chainage * 5.0, left * 5.0, 4, salt + 40);
  if (away < kShoulder || (side > 0 && std::abs(away - 27.0) < 1.7)) {
    surface.colour = glm::vec3(0.6f, 0.56f, 0.5f) * (0.5f + 0.8f * gravel);
    return surface;
  }
  const float rough = fractal_noise(chainage * 1.4, left * 1.4, 3, salt + 50);
  surface.height += 0.25 * rough * smooth_step(kShoulder, kShoulder + 2, away);
  surface.colour = grass(chainage, left, salt + 60);
  const float bare = fractal_noise(chainage / 30.0, left / 18.0, 4, salt + 70);
  surface.colour = glm::mix(surface.colour, glm::vec3(0.48f, 0.38f, 0.26f) * (0.5f + 0.8f * gravel),
                            0.8f * static_cast<float>(smooth_step(0.58, 0.66, bare)));
  return surface;
}

}  // namespace stipple::scene
