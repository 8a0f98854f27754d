#include "src/scene/city_plan.h"

#include <algorithm>
#include <cmath>

#include "src/scene/city_builder.h"
#include "src/scene/noise.h"

namespace stipple::scene {
namespace {

constexpr int kBlocksX = 10;
constexpr int kBlocksY = 12;
constexpr int kMostStoreys = 22;  // below 80 m

// Parked cars, lamps and trees along the four sides of a block.
void furnish_street(CityBuilder& city, const Rect& cell) {
  for (int side = 0; side < 4; ++side) {
    const bool along_x = side < 2;
    const double length = along_x ? kBlockX : kBlockY;
    // From distance along the side and away from the road's centre line to the plan
    const auto place = [&](double along, double away) {
      if (side == 0) return glm::dvec2(cell.low.x + along, cell.low.y + away);
      if (side == 1) return glm::dvec2(cell.low.x + along, cell.high.y - away);
      if (side == 2) return glm::dvec2(cell.low.x + away, cell.low.y + along);
      return glm::dvec2(cell.high.x - away, cell.low.y + along);
    };
    for (double along = 20; along < length - 20; along += 6.2)
      if (city.random().uniform() < 0.6) city.add_car(place(along, 5.7), along_x);
    for (double along = 16; along < length - 14; along += 9.5) {
      const double shift = city.random().uniform(-1, 1);
      if (city.random().uniform() < 0.75)
        city.add_tree(place(along + shift, kCarriageway + 1.3), city.random().uniform(6, 11), Species::broadleaf);
    }
    for (double along = 21; along < length - 14; along += 28.5)
      city.add_lamp(place(along, kCarriageway + 0.5), place(along, kCarriageway - 1.4));
  }
}

void fill_park(CityBuilder& city, const Rect& block) {
  city.add_ground(block, Material::park);
  for (int i = 0; i < 45; ++i) {
    const glm::dvec2 at(city.random().uniform(block.low.x + 4, block.high.x - 4),
                        city.random().uniform(block.low.y + 4, block.high.y - 4));
    const glm::dvec2 off = glm::abs(at - 0.5 * (block.low + block.high));
    if (off.x < 3 || off.y < 3) continue;  // the paths
    const double kind = city.random().uniform();
    if (kind < 0.3)
      city.add_tree(at, city.random().uniform(1, 2.5), Species::shrub);
    else
      city.add_tree(at, city.random().uniform(9, 17), kind < 0.5 ? Species::birch : Species::broadleaf);
  }
}

// Storeys fall from the middle of the city outwards, and vary from lot to lot.
int storeys_at(CityBuilder& city, const glm::dvec2& at) {
  const double away = glm::length(at - 0.5 * kCitySize) / (0.5 * kCitySize);
  const double tallest = 3.0 + 20.0 * smooth_step(1.1, 0.1, away);
  const double u = city.random().uniform();
  return std::min(kMostStoreys, 2 + static_cast<int>(tallest * u * u + 3.0 * city.random().uniform()));
}

Building random_building(CityBuilder& city, int storeys) {
  static constexpr glm::vec3 kColours[] = {
      {0.62f, 0.3f, 0.21f},  {0.5f, 0.25f, 0.2f},   {0.72f, 0.45f, 0.3f},    // brick
      {0.88f, 0.82f, 0.66f}, {0.85f, 0.7f, 0.55f},  {0.8f, 0.82f, 0.8f},     // plaster
      {0.66f, 0.65f, 0.62f}, {0.75f, 0.72f, 0.66f}, {0.55f, 0.57f, 0.6f},    // panel
      {0.35f, 0.42f, 0.48f}, {0.28f, 0.3f, 0.33f},  {0.42f, 0.46f, 0.44f}};  // curtain
  PointRandom& random = city.random();
  Building building;
  const std::uint32_t kind = storeys > 9 ? 2 + random.below(2) : random.below(3);
  building.wall = static_cast<WallKind>(kind);
  building.colour = kColours[3 * kind + random.below(3)];
  building.roof_colour = random.uniform() < 0.7 ? glm::vec3(0.58f, 0.28f, 0.18f) : glm::vec3(0.32f, 0.33f, 0.36f);
  building.storey_height = random.uniform(2.9, 3.5);
  building.bay_width = random.uniform(2.4, 3.8);
  building.window_width = building.wall == WallKind::curtain ? 0.95 : random.uniform(0.4, 0.7);
  building.window_height = building.wall == WallKind::curtain ? 0.82 : random.uniform(0.45, 0.62);
  building.salt = static_cast<std::uint32_t>(random.bits());
  return building;
}

void fill_lot(CityBuilder& city, const Rect& lot, bool large) {
  PointRandom& random = city.random();
  if (random.uniform() < 0.08) {
    city.add_ground(lot, Material::park);
    for (int i = 0; i < 5; ++i)
      city.add_tree({random.uniform(lot.low.x + 4, lot.high.x - 4), random.uniform(lot.low.y + 4, lot.high.y - 4)},
                    random.uniform(5, 13), Species::broadleaf);
    return;
  }
  const glm::dvec2 margin_low(random.uniform(1.2, 4), random.uniform(1.2, 5));
  const glm::dvec2 margin_high(random.uniform(1.2, 4), random.uniform(1.2, 5));
  const Rect footprint{lot.low + margin_low, lot.high - margin_high};
  city.add_ground_ring(lot, footprint, Material::yard);

  int storeys = storeys_at(city, footprint.low);
  if (large) storeys = std::min(storeys + 1, 7);
  Building building = random_building(city, storeys);
  building.floor_z = city.highest_ground(footprint) + 0.35;
  if (storeys > 11) {
    const glm::dvec2 inset = 0.14 * (footprint.high - footprint.low);
    const double podium = city.add_storeys(building, footprint, building.floor_z, 3, 0);
    building.floor_z = podium;
    const double top =
        city.add_storeys(building, {footprint.low + inset, footprint.high - inset}, podium, storeys - 3, 1);
    city.add_flat_roof({footprint.low + inset, footprint.high - inset}, top);
    city.add_flat_roof(footprint, podium);
    return;
  }
  const double top = city.add_storeys(building, footprint, building.floor_z, storeys, 0);
  if (storeys < 6 && !large && building.wall != WallKind::panel)
    city.add_gable_roof(footprint, top);
  else
    city.add_flat_roof(footprint, top);
}

void fill_block(CityBuilder& city, const Rect& block) {
  const double kind = city.random().uniform();
  if (kind < 0.1) return fill_park(city, block);
  const bool large = kind < 0.24;
  const glm::dvec2 lots = large ? glm::dvec2(1, 1) : glm::dvec2(3, 2);
  const glm::dvec2 size = (block.high - block.low) / lots;
  for (double j = 0; j < lots.y; ++j)
    for (double i = 0; i < lots.x; ++i) {
      const glm::dvec2 low = block.low + size * glm::dvec2(i, j);
      fill_lot(city, {low, low + size}, large);
    }
}

}  // namespace

double city_ground(double x, double y, std::uint32_t salt) {
  return 13.0 * value_noise(x / 410.0, y / 410.0, salt) + 2.5 * value_noise(x / 140.0, y / 140.0, salt + 1);
}

FacadeGrid facade_grid(const Building& building, const Surface& facade) {
  const double width = glm::length(facade.edge_u);
  const int bays = std::max(1, static_cast<int>(width / building.bay_width + 0.5));
  const int storeys = std::max(1, static_cast<int>(facade.edge_v.z / building.storey_height + 0.5));
  const double bay_width = width / bays;
  const double side = 0.5 * (1 - building.window_width) * bay_width;
  const double sill = 0.55 * (1 - building.window_height) * building.storey_height;
  return {bays,
          storeys,
          bay_width,
          building.storey_height,
          {{side, sill}, {bay_width - side, sill + building.window_height * building.storey_height}}};
}

CityPlan plan_city(std::uint64_t seed) {
  CityBuilder city(seed);
  for (int j = 0; j < kBlocksY; ++j)
    for (int i = 0; i < kBlocksX; ++i) {
      const glm::dvec2 low(i * kBlockX, j * kBlockY);
      const Rect cell{low, low + glm::dvec2(kBlockX, kBlockY)};
      const Rect kerb{cell.low + kCarriageway, cell.high - kCarriageway};
      const Rect block{kerb.low + kPavement, kerb.high - kPavement};
      city.add_ground_ring(cell, kerb, Material::road);
      city.add_kerb(kerb);
      city.add_ground_ring(kerb, block, Material::pavement);
      furnish_street(city, cell);
      fill_block(city, block);
    }
  return std::move(city).finish();
}

}  // namespace stipple::scene
