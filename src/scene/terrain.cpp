#include "src/scene/terrain.h"

#include <algorithm>
#include <cmath>

#include "src/scene/noise.h"
#include "src/scene/random.h"
#include "src/scene/relief.h"
#include "src/scene/texture.h"
#include "src/scene/trig.h"

namespace stipple::scene {
namespace {

constexpr std::uint64_t kStrips = 8;
constexpr double kSwath = 560.0;                                      // width of a strip
constexpr double kPitch = (kTerrainSize - kSwath) / (kStrips - 1.0);  // 491 m: strips overlap by 69 m

struct Cover {
  glm::vec3 colour;
  double relief = 0.0;  // metres above the bare ground
  PointClass point_class = PointClass::ground;
};

// A field of one crop, sown in rows; tracks of 3 m between the fields.
Cover field_cover(const glm::dvec2& at, std::uint32_t salt) {
  constexpr glm::dvec2 kField(210, 120);
  constexpr double kTrack = 3.0;
  // The fields lie 20 degrees off the grid, every second column shifted
  constexpr glm::dvec2 kAlong(0.9397, 0.3420);
  glm::dvec2 p(glm::dot(at, kAlong), kAlong.x * at.y - kAlong.y * at.x);
  const double column = static_cast<double>(floor_of(p.x / kField.x));
  p.y += 47.0 * column;
  const glm::dvec2 number(column, static_cast<double>(floor_of(p.y / kField.y)));
  const glm::dvec2 within = p - number * kField;
  const auto crop = hash(static_cast<std::uint32_t>(static_cast<std::int64_t>(number.x)),
                         static_cast<std::uint32_t>(static_cast<std::int64_t>(number.y)), salt + 200);
  const glm::dvec2 edge = glm::min(within, kField - within);
  const float dirt = fractal_noise(at.x / 4.0, at.y / 4.0, 4, salt + 210);
  if (std::min(edge.x, edge.y) < kTrack / 2) return {glm::vec3(0.6f, 0.52f, 0.4f) * (0.6f + 0.6f * dirt)};

  static constexpr glm::vec3 kCrops[] = {
      {0.42f, 0.5f, 0.16f}, {0.76f, 0.66f, 0.34f}, {0.26f, 0.42f, 0.14f}, {0.44f, 0.34f, 0.24f}, {0.82f, 0.74f, 0.2f}};
  const std::uint32_t kind = crop % std::size(kCrops);
  const double spacing = 0.75 + 0.75 * unit(mix32(crop));
  const double across = (crop & 256) ? within.x : within.y;
  const double row = 0.5 + 0.5 * sin_turns(across / spacing + 0.2 * value_noise(at.x / 3.0, at.y / 3.0, salt + 220));
  // A tractor's two wheels every 18 m
  const double lane = 18.0 * fraction_of(across / 18.0);
  const bool wheel = std::abs(lane - 8.1) < 0.25 || std::abs(lane - 9.9) < 0.25;
  const bool bare = kind == 3 || wheel;
  const float growth = fractal_noise(at.x / 45.0, at.y / 45.0, 4, salt + 230);
  const glm::vec3 soil = glm::vec3(0.42f, 0.33f, 0.23f) * (0.6f + 0.7f * dirt);
  const glm::vec3 plant = kCrops[kind] * (0.6f + 0.45f * growth + 0.3f * dirt);
  const auto cover = static_cast<float>(bare ? 0.15 * row : 0.35 + 0.65 * row);
  Cover field{glm::mix(soil, plant, cover), bare ? 0.05 * row : 0.05 + 0.4 * row * growth};
  if (field.relief > 0.15) field.point_class = PointClass::low_vegetation;
  return field;
}

Cover open_cover(const glm::dvec2& at, const Relief& relief, std::uint32_t salt) {
  const float steep = 1 - relief.normal.z;
  const float broad = fractal_noise(at.x / 160.0, at.y / 160.0, 5, salt + 300);
  const float fine = fractal_noise(at.x / 1.6, at.y / 1.6, 3, salt + 310);
  Cover cover{grass(at.x, at.y, salt + 320)};
  // Heath and scrub in patches on the slopes
  const auto scrub = static_cast<float>(smooth_step(0.5, 0.56, broad) * smooth_step(0.95, 0.7, relief.valley));
  cover.colour = glm::mix(cover.colour, glm::vec3(0.15f, 0.24f, 0.1f) * (0.4f + 1.2f * fine), scrub);
  cover.relief = 1.4 * scrub * std::max(0.0f, fine - 0.35f);
  if (cover.relief > 0.2) cover.point_class = PointClass::low_vegetation;
  // High up the grass dries, then gives way to rock; slopes too steep for soil show strata
  const auto high = static_cast<float>(smooth_step(300, 430, relief.height + 160.0 * (broad - 0.5)));
  cover.colour = glm::mix(cover.colour, glm::vec3(0.58f, 0.54f, 0.4f) * (0.45f + 1.0f * fine), 0.8f * high);
  const auto rock = static_cast<float>(smooth_step(0.13, 0.2, steep + 0.12f * (fine - 0.5f) + 0.05f * high));
  if (rock > 0) {
    const float strata = value_noise(relief.height / 2.5 + 3.0 * broad, broad * 8.0, salt + 330);
    const glm::vec3 stone = glm::vec3(0.56f, 0.52f, 0.48f) * (0.35f + 0.5f * strata + 0.6f * fine);
    cover.colour = glm::mix(cover.colour, stone, rock);
  }
  return cover;
}

Cover cover_at(const glm::dvec2& at, const Relief& relief, std::uint32_t salt) {
  if (relief.depth > 0) {
    const float ripple = fractal_noise(at.x / 5.0, at.y / 12.0, 5, salt + 400);
    const auto deep = static_cast<float>(smooth_step(0, 14, relief.depth));
    return {glm::mix(glm::vec3(0.42f, 0.45f, 0.38f), glm::vec3(0.14f, 0.27f, 0.33f), deep) * (0.7f + 0.6f * ripple),
            0.08 * ripple, PointClass::water};
  }
  if (relief.to_river < 40) {
    const float pebbles = fractal_noise(at.x * 1.5, at.y * 1.5, 4, salt + 410);
    return {glm::mix(glm::vec3(0.66f, 0.62f, 0.54f) * (0.5f + 0.9f * pebbles), grass(at.x, at.y, salt + 320),
                     static_cast<float>(smooth_step(30, 40, relief.to_river + 6.0 * pebbles)))};
  }
  const bool field = relief.valley > 0.86f && relief.to_river > 55;
  return field ? field_cover(at, salt) : open_cover(at, relief, salt);
}

class Terrain : public SceneModel {
 public:
  Terrain(std::uint64_t points, std::uint64_t seed)
      : points_(points), seed_(seed), salt_(static_cast<std::uint32_t>(mix64(seed ^ 0x7E44A1Bull))) {}

  Grid grid() const override { return {{412000.0, 5268000.0, 500.0}, glm::dvec3(0.001)}; }
  WorldBox bounds() const override {
    const glm::dvec3 origin = grid().offset;
    return {origin + glm::dvec3(0, 0, -50), origin + glm::dvec3(kTerrainSize, kTerrainSize, 1300)};
  }

  ScenePoint point(std::uint64_t index) const override {
    PointRandom random(seed_, index);
    const glm::dvec2 at = mirror(index, random);
    const Relief relief = relief_at(at, salt_);
    const Cover cover = cover_at(at, relief, salt_);
    ScenePoint point;
    point.position = glm::dvec3(at, relief.height + cover.relief + 0.015 * random.normal());
    point.colour = 1.1f * cover.colour * sunlight(relief.normal);
    point.intensity = relief.depth > 0 ? 0.05f : 0.15f + 0.7f * luminance(cover.colour);
    point.point_class = cover.point_class;
    return point;
  }

 private:
  // Where the beam of pulse `index` meets the plan.
  glm::dvec2 mirror(std::uint64_t index, PointRandom& random) const {
    const std::uint64_t strip = std::min(index * kStrips / points_, kStrips - 1);
    const std::uint64_t first = (strip * points_ + kStrips - 1) / kStrips;
    const std::uint64_t end = ((strip + 1) * points_ + kStrips - 1) / kStrips;
    const auto pulses = static_cast<double>(end - first);
    // As many sweeps as make points about as far apart along the flight as across it
    const double sweeps = std::max(1.0, static_cast<double>(floor_of(std::sqrt(pulses * kTerrainSize / kSwath))));
    const double flown = (static_cast<double>(index - first) + random.uniform()) / pulses;
    const double phase = flown * sweeps * 0.5;
    const double swing = std::abs(2 * fraction_of(phase) - 1);
    const double jitter = kTerrainSize / sweeps * (random.uniform() - 0.5);
    const double y = std::clamp(flown * kTerrainSize + jitter, 0.0, kTerrainSize);
    const double x = static_cast<double>(strip) * kPitch + swing * kSwath;
    // Strips are flown there and back
    return {x, strip & 1 ? kTerrainSize - y : y};
  }

  std::uint64_t points_;
  std::uint64_t seed_;
  std::uint32_t salt_;
};

}  // namespace

std::unique_ptr<SceneModel> make_terrain(std::uint64_t points, std::uint64_t seed) {
  return std::make_unique<Terrain>(points, seed);
}

}  // namespace stipple::scene
