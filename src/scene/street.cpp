#include "src/scene/street.h"

#include <algorithm>
#include <cmath>

#include "src/scene/noise.h"
#include "src/scene/texture.h"

namespace stipple::scene {
namespace {

// Signed distance to the nearest multiple of `period`.
double offset_from_multiple(double x, double period) {
  return period * (fraction_of(x / period + 0.5) - 0.5);
}

// `across` from the centre line, `along` it, `to_crossing` from the centre line of the nearest road across.
bool is_marked(double across, double along, double to_crossing) {
  constexpr double kStroke = 0.075;  // half a line's width
  const double off = std::abs(across);
  if (to_crossing < kCarriageway) return false;
  if (to_crossing < 8.5) return false;
  if (to_crossing < 12.5) return fraction_of(across) < 0.5 && off < 6.5;  // zebra
  if (to_crossing < 13.5) return false;
  if (to_crossing < 13.9) return off < 4.6 && (across > 0) == (along > 0);  // stop line
  if (off < kStroke) return fraction_of(along / 4.0) < 0.5;
  // Bays for parked cars: a line, and a stroke between cars
  if (std::abs(off - 4.7) < kStroke) return true;
  return off > 4.7 && std::abs(offset_from_multiple(along - 3.1, 6.2)) < kStroke;
}

}  // namespace

glm::vec3 road_colour(const glm::dvec2& at, std::uint32_t salt) {
  const glm::vec3 surface = asphalt(at.x, at.y, salt);
  const double off_x = offset_from_multiple(at.x, kBlockX);
  const double off_y = offset_from_multiple(at.y, kBlockY);
  const bool runs_north = std::abs(off_x) < kCarriageway;
  const bool marked = runs_north ? is_marked(off_x, off_y, std::abs(off_y)) : is_marked(off_y, off_x, std::abs(off_x));
  if (marked) {
    const float wear = fractal_noise(at.x * 2.5, at.y * 2.5, 4, salt + 79);
    return glm::mix(glm::vec3(0.85f, 0.85f, 0.82f), surface, wear > 0.58f ? 0.75f : 0.6f * wear);
  }

  // One manhole in every square of 9 m that drew one
  const std::int64_t sx = floor_of(at.x / 9.0);
  const std::int64_t sy = floor_of(at.y / 9.0);
  if (cell_value(sx, sy, salt + 83) < 0.25f) {
    const glm::dvec2 lid = 9.0 * (glm::dvec2(sx, sy) + 0.2 +
                                  0.6 * glm::dvec2(cell_value(sx, sy, salt + 84), cell_value(sx, sy, salt + 85)));
    const double away = glm::length(at - lid);
    if (away < 0.38) return glm::vec3(away > 0.33 ? 0.12f : 0.3f) * (fraction_of(at.x * 12) < 0.3 ? 0.7f : 1.0f);
  }
  return surface;
}

glm::vec3 ground_colour(Material material, const glm::dvec2& at, std::uint32_t salt) {
  if (material == Material::pavement) return paving(at.x, at.y, 0.5, {0.66f, 0.64f, 0.6f}, salt);
  if (material == Material::yard) {
    // Every lot is paved in places and green in others
    const float kind = fractal_noise(at.x / 17.0, at.y / 17.0, 2, salt + 89);
    if (kind < 0.5f) return grass(at.x, at.y, salt);
    return paving(at.x, at.y, 0.24, kind > 0.6f ? glm::vec3(0.58f, 0.42f, 0.36f) : glm::vec3(0.55f, 0.53f, 0.5f), salt);
  }
  const glm::dvec2 from_middle(std::abs(offset_from_multiple(at.x - 0.5 * kBlockX, kBlockX)),
                               std::abs(offset_from_multiple(at.y - 0.5 * kBlockY, kBlockY)));
  const double ragged = 0.5 * value_noise(at.x * 0.9, at.y * 0.9, salt + 97);
  if (std::min(from_middle.x, from_middle.y) + ragged < 1.8) {
    const float gravel = fractal_noise(at.x * 8.0, at.y * 8.0, 3, salt + 101);
    return glm::vec3(0.72f, 0.64f, 0.5f) * (0.65f + 0.5f * gravel);
  }
  return grass(at.x, at.y, salt);
}

}  // namespace stipple::scene
