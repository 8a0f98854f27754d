#include "src/scene/texture.h"

#include <algorithm>
#include <cmath>

#include "src/scene/noise.h"

namespace stipple::scene {
namespace {

// Distance to the nearest multiple of `period`.
double distance_to_multiple(double x, double period) {
  return period * std::abs(fraction_of(x / period + 0.5) - 0.5);
}

std::int64_t cell_of(double x, double size) {
  return floor_of(x / size);
}

}  // namespace

float sunlight(const glm::vec3& normal) {
  constexpr glm::vec3 kSun{-0.4856f, -0.5665f, 0.6658f};
  return 0.45f + 0.1f * normal.z + 0.6f * std::max(glm::dot(normal, kSun), 0.0f);
}

float luminance(const glm::vec3& colour) {
  return glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f));
}

glm::vec3 plaster(double u, double v, const glm::vec3& base, std::uint32_t salt) {
  const float stain = fractal_noise(u * 0.4, v * 0.3, 2, salt);
  // Rain runs down: narrow across, long along
  const float streak = value_noise(u * 5.0, v * 0.5, salt + 11);
  const float grain = fractal_noise(u * 9.0, v * 9.0, 2, salt + 23);
  return base * (0.72f + 0.2f * stain + 0.14f * streak + 0.2f * grain);
}

glm::vec3 brick_wall(double u, double v, const glm::vec3& base, std::uint32_t salt) {
  constexpr double kLength = 0.25;
  constexpr double kHeight = 0.08;
  constexpr double kHalfJoint = 0.006;
  const std::int64_t row = cell_of(v, kHeight);
  const double shifted = u + ((row & 1) ? 0.5 * kLength : 0.0);
  const float stain = fractal_noise(u * 0.5, v * 0.5, 3, salt);
  if (distance_to_multiple(shifted, kLength) < kHalfJoint || distance_to_multiple(v, kHeight) < kHalfJoint)
    return glm::vec3(0.62f, 0.59f, 0.54f) * (0.8f + 0.35f * stain);
  const float brick = cell_value(cell_of(shifted, kLength), row, salt + 31);
  const float grain = value_noise(u * 30.0, v * 30.0, salt + 37);
  return base * (0.68f + 0.26f * brick + 0.26f * stain + 0.1f * grain);
}

glm::vec3 paving(double u, double v, double size, const glm::vec3& base, std::uint32_t salt) {
  constexpr double kHalfJoint = 0.008;
  const float dirt = fractal_noise(u * 0.35, v * 0.35, 4, salt);
  if (distance_to_multiple(u, size) < kHalfJoint || distance_to_multiple(v, size) < kHalfJoint)
    return base * (0.35f + 0.3f * dirt);
  const float slab = cell_value(cell_of(u, size), cell_of(v, size), salt + 41);
  const float grain = value_noise(u * 22.0, v * 22.0, salt + 43);
  return base * (0.66f + 0.14f * slab + 0.36f * dirt + 0.12f * grain);
}

glm::vec3 roof_tiles(double u, double v, const glm::vec3& base, std::uint32_t salt) {
  constexpr double kRow = 0.3;
  constexpr double kTile = 0.24;
  const std::int64_t row = cell_of(v, kRow);
  const double shifted = u + ((row & 1) ? 0.5 * kTile : 0.0);
  const auto up = static_cast<float>(v / kRow - static_cast<double>(row));
  const float tile = cell_value(cell_of(shifted, kTile), row, salt);
  const float moss = fractal_noise(u * 0.6, v * 0.6, 3, salt + 47);
  // The lower edge of a tile is worn bright, its upper end lies in the shadow of the next
  const float relief = up > 0.85f ? 0.6f : 1.05f - 0.15f * up;
  return glm::mix(base * (0.75f + 0.35f * tile), glm::vec3(0.3f, 0.32f, 0.2f), 0.7f * moss * moss) * relief;
}

glm::vec3 boards(double u, double v, const glm::vec3& base, std::uint32_t salt) {
  constexpr double kWidth = 0.14;
  constexpr double kLength = 1.6;
  constexpr double kHalfJoint = 0.003;
  const std::int64_t row = cell_of(v, kWidth);
  const double shifted = u + kLength * cell_value(row, 0, salt + 53);
  if (distance_to_multiple(v, kWidth) < kHalfJoint || distance_to_multiple(shifted, kLength) < kHalfJoint)
    return base * 0.4f;
  const std::int64_t board = cell_of(shifted, kLength);
  const float tone = cell_value(board, row, salt);
  const float grain = fractal_noise(u * 3.0 + 7.0 * tone, v * 45.0, 2, salt + 59);
  return base * (0.65f + 0.3f * tone + 0.3f * grain);
}

glm::vec3 asphalt(double u, double v, std::uint32_t salt) {
  const float patch = fractal_noise(u * 0.12, v * 0.12, 3, salt);
  const float grain = fractal_noise(u * 11.0, v * 11.0, 2, salt + 61);
  const float crack = std::abs(fractal_noise(u * 0.7, v * 0.7, 3, salt + 67) - 0.5f);
  const float tone = (0.2f + 0.16f * patch + 0.1f * grain) * (crack < 0.008f ? 0.55f : 1.0f);
  return tone * glm::vec3(1.0f, 1.0f, 1.04f);
}

glm::vec3 grass(double u, double v, std::uint32_t salt) {
  const float patch = fractal_noise(u / 12.0, v / 12.0, 4, salt);
  const float tuft = fractal_noise(u * 3.0, v * 3.0, 3, salt + 71);
  const glm::vec3 hue = glm::mix(glm::vec3(0.2f, 0.36f, 0.11f), glm::vec3(0.46f, 0.46f, 0.2f), 1.6f * patch - 0.4f);
  return hue * (0.55f + 0.9f * tuft);
}

glm::vec3 forest_floor(double u, double v, std::uint32_t salt) {
  const float moss = fractal_noise(u / 5.0, v / 5.0, 4, salt);
  const float litter = fractal_noise(u * 4.0, v * 4.0, 3, salt + 73);
  const glm::vec3 hue = glm::mix(glm::vec3(0.36f, 0.25f, 0.15f), glm::vec3(0.24f, 0.33f, 0.12f),
                                 static_cast<float>(smooth_step(0.45, 0.62, moss)));
  return hue * (0.45f + 1.1f * litter);
}

}  // namespace stipple::scene
