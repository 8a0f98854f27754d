// Value noise on integer lattices, hashed instead of tabulated.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "src/scene/floor.h"

namespace stipple::scene {

// "lowbias32", Wellons 2018.
inline std::uint32_t mix32(std::uint32_t v) {
  v = (v ^ (v >> 16)) * 0x7FEB352Du;
  v = (v ^ (v >> 15)) * 0x846CA68Bu;
  return v ^ (v >> 16);
}

inline std::uint32_t hash(std::uint32_t a, std::uint32_t b, std::uint32_t salt) {
  return mix32(a * 0x9E3779B1u + b * 0x85EBCA77u + salt * 0xC2B2AE3Du);
}

// The upper 24 bits as a number in [0, 1).
inline float unit(std::uint32_t bits) {
  return static_cast<float>(bits >> 8) * 0x1p-24f;
}

// A number in [0, 1) that belongs to lattice cell (a, b).
inline float cell_value(std::int64_t a, std::int64_t b, std::uint32_t salt) {
  return unit(hash(static_cast<std::uint32_t>(a), static_cast<std::uint32_t>(b), salt));
}

// 0 below `low`, 1 above `high`, smooth between.
inline double smooth_step(double low, double high, double x) {
  const double t = std::clamp((x - low) / (high - low), 0.0, 1.0);
  return t * t * (3 - 2 * t);
}

// A value in [0, 1] and its derivatives.
struct NoiseSample {
  double value = 0;
  double dx = 0;
  double dy = 0;
};

// Quintic interpolation between the four corners of the unit cell around (x, y).
inline NoiseSample value_noise_gradient(double x, double y, std::uint32_t salt) {
  const std::int64_t ix = floor_of(x);
  const std::int64_t iy = floor_of(y);
  const double u = x - static_cast<double>(ix);
  const double v = y - static_cast<double>(iy);
  const double su = u * u * u * (u * (u * 6 - 15) + 10);
  const double sv = v * v * v * (v * (v * 6 - 15) + 10);
  const double du = 30 * u * u * (u * (u - 2) + 1);
  const double dv = 30 * v * v * (v * (v - 2) + 1);
  const double a = cell_value(ix, iy, salt);
  const double b = cell_value(ix + 1, iy, salt);
  const double c = cell_value(ix, iy + 1, salt);
  const double d = cell_value(ix + 1, iy + 1, salt);
  const double k = a - b - c + d;
  return {a + (b - a) * su + (c - a) * sv + k * su * sv, du * (b - a + k * sv), dv * (c - a + k * su)};
}

// The value alone, with the cheaper cubic.
inline float value_noise(double x, double y, std::uint32_t salt) {
  const std::int64_t ix = floor_of(x);
  const std::int64_t iy = floor_of(y);
  const auto u = static_cast<float>(x - static_cast<double>(ix));
  const auto v = static_cast<float>(y - static_cast<double>(iy));
  const float su = u * u * (3 - 2 * u);
  const float sv = v * v * (3 - 2 * v);
  const float a = cell_value(ix, iy, salt);
  const float b = cell_value(ix + 1, iy, salt);
  const float c = cell_value(ix, iy + 1, salt);
  const float d = cell_value(ix + 1, iy + 1, salt);
  return a + (b - a) * su + (c - a) * sv + (a - b - c + d) * su * sv;
}

// Octaves of value noise, each of half the size and strength of the one before; in [0, 1], mean one half. The largest
// features are one unit of x and y wide.
inline float fractal_noise(double x, double y, int octaves, std::uint32_t salt) {
  float sum = 0;
  float weight = 1;
  float total = 0;
  for (int i = 0; i < octaves; ++i) {
    sum += weight * value_noise(x, y, salt + static_cast<std::uint32_t>(i));
    total += weight;
    weight *= 0.5f;
    // Not quite 2, so that the lattices of the octaves do not line up
    x = x * 2.03 + 17.3;
    y = y * 2.03 + 9.7;
  }
  return sum / total;
}

}  // namespace stipple::scene
