#include "src/scene/relief.h"

#include <algorithm>
#include <cmath>

#include "src/scene/noise.h"
#include "src/scene/trig.h"

namespace stipple::scene {
namespace {

constexpr double kRiver = 22.0;        // half its width
constexpr double kBank = 9.0;          // width of a bank
constexpr double kValleyFrom = 130.0;  // metres from the river at which the hills begin to rise
constexpr double kValleyTo = 1500.0;

struct Slope {
  double height;
  glm::dvec2 gradient;
};

// Octaves that grow faint where the coarser ones are steep, as on slopes worn smooth by water (Quilez 2008).
Slope hills(glm::dvec2 p, std::uint32_t salt) {
  constexpr int kOctaves = 8;  // down to 12 m
  constexpr double kWidth = 1500.0;
  constexpr double kHeight = 560.0;
  p /= kWidth;
  double sum = 0;
  double weight = 1;
  double frequency = 1;
  glm::dvec2 steepness(0);
  glm::dvec2 gradient(0);
  for (int i = 0; i < kOctaves; ++i) {
    const NoiseSample n = value_noise_gradient(p.x, p.y, salt + static_cast<std::uint32_t>(i));
    const glm::dvec2 d = 2.0 * glm::dvec2(n.dx, n.dy);
    steepness += 0.35 * weight * frequency * d;
    const double damping = 1 / (1 + glm::dot(steepness, steepness));
    sum += weight * n.value * damping;
    gradient += 0.5 * weight * frequency * d * damping;
    weight *= 0.5;
    frequency *= 2;
    // Turn by 36.87 degrees so that the lattices do not line up
    p = 2.0 * glm::dvec2(0.8 * p.x - 0.6 * p.y, 0.6 * p.x + 0.8 * p.y);
    const double cos36 = 0.8;
    const double sin36 = 0.6;
    gradient = {cos36 * gradient.x - sin36 * gradient.y, sin36 * gradient.x + cos36 * gradient.y};
    steepness = {cos36 * steepness.x - sin36 * steepness.y, sin36 * steepness.x + cos36 * steepness.y};
  }
  // Undo the turns of all octaves at once
  const glm::dvec2 back = direction_from_turns(-kOctaves * 0.10241638234956672);
  gradient = {back.x * gradient.x - back.y * gradient.y, back.y * gradient.x + back.x * gradient.y};
  return {kHeight * sum, kHeight / kWidth * gradient};
}

struct River {
  double x;
  double slope;  // dx / dy
};

River river_at(double y) {
  const double a = y / 2900.0;
  const double b = y / 870.0;
  return {1900.0 + 420.0 * sin_turns(a + 0.1) + 110.0 * sin_turns(b),
          6.283185307179586 * (420.0 / 2900.0 * cos_turns(a + 0.1) + 110.0 / 870.0 * cos_turns(b))};
}

}  // namespace

Relief relief_at(const glm::dvec2& at, std::uint32_t salt) {
  const River river = river_at(at.y);
  const double obliqueness = 1 / std::sqrt(1 + river.slope * river.slope);
  const double signed_distance = (at.x - river.x) * obliqueness;
  const double away = std::abs(signed_distance);
  const double side = signed_distance < 0 ? -1.0 : 1.0;
  const glm::dvec2 outward = side * obliqueness * glm::dvec2(1, -river.slope);

  // Blend from the valley floor into the hills
  const double t = std::clamp((away - kValleyFrom) / (kValleyTo - kValleyFrom), 0.0, 1.0);
  const double hilly = t * t * (3 - 2 * t);
  const double hilly_slope = 6 * t * (1 - t) / (kValleyTo - kValleyFrom);
  const NoiseSample swell = value_noise_gradient(at.x / 130.0, at.y / 130.0, salt + 50);
  const double fall = 0.004;  // of the valley, towards the north
  const double floor = 40.0 + 5.0 * swell.value + 0.012 * away - fall * at.y;
  const glm::dvec2 floor_slope = 5.0 / 130.0 * glm::dvec2(swell.dx, swell.dy) + 0.012 * outward - glm::dvec2(0, fall);
  const Slope hill = hilly > 0 ? hills(at, salt) : Slope{0.0, {}};

  Relief relief;
  relief.valley = static_cast<float>(1 - hilly);
  relief.to_river = away;
  relief.height = floor + hilly * hill.height;
  glm::dvec2 slope = floor_slope + hilly * hill.gradient + hilly_slope * hill.height * outward;

  // Dig the bed: banks 3 m high
  if (away < kRiver + 2 * kBank) {
    const double ragged = away + kBank * (fractal_noise(at.x / 35.0, at.y / 35.0, 4, salt + 60) - 0.5);
    const double bank = smooth_step(kRiver, kRiver + kBank, ragged);
    const double level = 34.5 - fall * at.y;
    relief.height = level + (relief.height - level) * (0.05 + 0.95 * bank);
    if (ragged < kRiver) {
      relief.depth = kRiver - ragged;
      relief.height = level;
      slope = {0.0, -fall};
    }
  }
  relief.normal = glm::vec3(glm::normalize(glm::dvec3(-slope, 1)));
  return relief;
}

}  // namespace stipple::scene
