#include "src/scene/city.h"

#include <algorithm>
#include <cmath>

#include "src/scene/city_plan.h"
#include "src/scene/facade.h"
#include "src/scene/noise.h"
#include "src/scene/random.h"
#include "src/scene/street.h"
#include "src/scene/texture.h"

namespace stipple::scene {
namespace {

// Metres along the edges of a surface, and shares of them.
struct SurfacePlace {
  glm::dvec2 metres;
  glm::dvec2 share;
};

glm::vec3 inside_colour(const Surface& surface, const Building& building, const glm::dvec3& at,
                        const SurfacePlace& place) {
  const glm::dvec2& uv = place.metres;
  const auto storey = static_cast<std::uint32_t>((surface.origin.z - building.floor_z) / building.storey_height + 0.5);
  const float paint = cell_value(storey, static_cast<std::int64_t>(surface.origin.x), building.salt);
  switch (surface.material) {
    case Material::floor:
      if (building.wall == WallKind::plaster) return boards(at.x, at.y, {0.58f, 0.42f, 0.27f}, building.salt + storey);
      return paving(at.x, at.y, 0.6, {0.5f, 0.5f, 0.52f}, building.salt + storey);
    case Material::ceiling:
      return paving(at.x, at.y, 0.6, {0.85f, 0.85f, 0.83f}, building.salt);
    default:
      break;
  }
  if (uv.y < 0.1) return {0.4f, 0.33f, 0.27f};  // skirting
  // A door in every wall, two metres from its start
  if (uv.y < 2.05 && uv.x > 2.0 && uv.x < 2.9) return boards(uv.y, uv.x, {0.5f, 0.38f, 0.26f}, building.salt + 1);
  return plaster(uv.x, uv.y, glm::mix(glm::vec3(0.92f, 0.9f, 0.84f), glm::vec3(0.7f, 0.8f, 0.85f), paint),
                 building.salt);
}

glm::vec3 car_colour(const Surface& surface, const SurfacePlace& place) {
  static constexpr glm::vec3 kPaints[] = {{0.82f, 0.82f, 0.83f}, {0.1f, 0.1f, 0.11f}, {0.45f, 0.47f, 0.5f},
                                          {0.6f, 0.08f, 0.07f},  {0.1f, 0.2f, 0.45f}, {0.7f, 0.68f, 0.6f}};
  const glm::vec3 paint = kPaints[surface.owner % std::size(kPaints)];
  const glm::dvec2 size(glm::length(surface.edge_u), glm::length(surface.edge_v));
  const glm::dvec2& uv = place.metres;
  const bool side = surface.edge_v.z > 0;
  if (surface.material == Material::car_cabin) {
    const glm::dvec2 edge = glm::min(uv, size - uv);
    const bool post = std::abs(uv.x - 0.5 * size.x) < 0.05 && size.x > 2;
    return side && edge.x > 0.1 && edge.y > 0.08 && !post ? glm::vec3(0.1f, 0.13f, 0.15f) : paint;
  }
  if (!side) return paint;
  const bool flank = size.x > 3;
  const glm::dvec2 wheel(std::min(uv.x, size.x - uv.x) - 0.8, uv.y - 0.18);
  const double hub = glm::length(wheel);
  if (flank && hub < 0.34) return glm::vec3(hub < 0.2 ? 0.55f : 0.06f);
  if (uv.y < 0.14) return glm::vec3(0.12f);
  if (flank) return std::abs(uv.x - 0.5 * size.x) < 0.015 ? 0.5f * paint : paint;
  if (uv.y > 0.4 && uv.y < 0.58 && std::min(uv.x, size.x - uv.x) < 0.4)
    return surface.owner & 64 ? glm::vec3(0.9f, 0.88f, 0.8f) : glm::vec3(0.65f, 0.05f, 0.04f);
  return paint;
}

class City : public SceneModel {
 public:
  City(std::uint64_t points, std::uint64_t seed) : points_(points), seed_(seed), plan_(plan_city(seed)) {}

  Grid grid() const override { return {{565000.0, 5934000.0, 0.0}, glm::dvec3(0.001)}; }
  WorldBox bounds() const override {
    const glm::dvec3 origin = grid().offset;
    return {origin, origin + glm::dvec3(kCitySize, kCitySize, 130.0)};
  }

  ScenePoint point(std::uint64_t index) const override {
    PointRandom random(seed_, index);
    const double place = (static_cast<double>(index) + random.uniform()) / static_cast<double>(points_);
    const Surface& surface = plan_.surfaces[plan_.areas.pick(place)];
    switch (surface.material) {
      case Material::tree:
        return sample_tree(plan_.trees[surface.owner], random);
      case Material::facade:
        return sample_facade(plan_.buildings[surface.owner], surface, random);
      default:
        return sample_flat(surface, random);
    }
  }

 private:
  ScenePoint sample_flat(const Surface& surface, PointRandom& random) const {
    glm::dvec2 share(random.uniform(), random.uniform());
    if (surface.material == Material::gable_wall && share.x + share.y > 1) share = 1.0 - share;
    const SurfacePlace place{share * glm::dvec2(glm::length(surface.edge_u), glm::length(surface.edge_v)), share};
    ScenePoint point;
    point.position = surface.origin + share.x * surface.edge_u + share.y * surface.edge_v;
    if (surface.material <= Material::kerb) {
      finish_ground(surface, point);
    } else {
      const glm::vec3 normal(glm::normalize(glm::cross(surface.edge_u, surface.edge_v)));
      finish_built(surface, place, normal, point);
    }
    return point;
  }

  void finish_ground(const Surface& surface, ScenePoint& point) const {
    const glm::dvec2 at(point.position);
    point.position.z += city_ground(at.x, at.y, plan_.salt);
    switch (surface.material) {
      case Material::road:
        point.colour = road_colour(at, plan_.salt);
        break;
      case Material::kerb:
        point.colour = plaster(at.x + at.y, point.position.z, {0.55f, 0.54f, 0.52f}, plan_.salt);
        break;
      default:
        point.position.z += kKerb;
        point.colour = ground_colour(surface.material, at, plan_.salt);
    }
    point.colour *= surface.material == Material::kerb ? 0.6f : sunlight({0, 0, 1});
    point.intensity = 0.1f + 0.8f * luminance(point.colour);
    point.point_class = surface.material == Material::road ? PointClass::road : PointClass::ground;
  }

  void finish_built(const Surface& surface, const SurfacePlace& place, const glm::vec3& normal,
                    ScenePoint& point) const {
    const glm::dvec3& at = point.position;
    point.point_class = PointClass::building;
    float light = sunlight(normal);
    switch (surface.material) {
      case Material::floor:
      case Material::ceiling:
      case Material::partition:
        point.colour = inside_colour(surface, plan_.buildings[surface.owner], at, place);
        light = 0.5f + 0.08f * normal.x;
        break;
      case Material::car_body:
      case Material::car_cabin:
        point.colour = car_colour(surface, place);
        point.point_class = PointClass::unclassified;
        break;
      case Material::lamp_post:
        point.colour = glm::vec3(0.36f, 0.38f, 0.38f);
        point.point_class = PointClass::unclassified;
        break;
      case Material::roof_unit:
        point.colour = boards(place.metres.x, place.metres.y, {0.66f, 0.68f, 0.7f}, surface.owner);
        break;
      default:
        point.colour = shell_colour(surface, plan_.buildings[surface.owner], at, place);
    }
    point.colour *= light;
    point.intensity = 0.15f + 0.7f * luminance(point.colour);
  }

  static glm::vec3 shell_colour(const Surface& surface, const Building& building, const glm::dvec3& at,
                                const SurfacePlace& place) {
    const glm::dvec2& uv = place.metres;
    switch (surface.material) {
      case Material::plinth:
        return paving(uv.x, uv.y, 0.6, {0.46f, 0.44f, 0.42f}, building.salt);
      case Material::parapet:
        return 1.05f * plaster(uv.x, uv.y, glm::mix(building.colour, glm::vec3(0.6f), 0.6f), building.salt);
      case Material::gable_roof:
        return roof_tiles(uv.x, uv.y, building.roof_colour, building.salt);
      case Material::gable_wall: {
        // The second edge is slanted: back to upright coordinates
        const double half = 0.5 * glm::length(surface.edge_u);
        return wall_colour(building, uv.x + half * place.share.y, surface.edge_v.z * place.share.y);
      }
      default: {
        const float puddle = fractal_noise(at.x / 6.0, at.y / 6.0, 4, building.salt);
        const glm::vec3 felt = asphalt(at.x, at.y, building.salt) + glm::vec3(0.16f);
        return puddle > 0.62f ? 0.6f * felt : felt * (0.8f + 0.4f * puddle);
      }
    }
  }

  std::uint64_t points_;
  std::uint64_t seed_;
  CityPlan plan_;
};

}  // namespace

std::unique_ptr<SceneModel> make_city(std::uint64_t points, std::uint64_t seed) {
  return std::make_unique<City>(points, seed);
}

}  // namespace stipple::scene
