#include "src/scene/city_builder.h"

#include <algorithm>
#include <cmath>

namespace stipple::scene {
namespace {

constexpr double kSlab = 0.3;    // thickness of a floor
constexpr double kInset = 0.25;  // inner surfaces end this far behind the facade

double area_of(const CityPlan& plan, const Surface& surface) {
  if (surface.material == Material::tree) return surface_area(plan.trees[surface.owner]);
  if (surface.material == Material::facade) {
    const FacadeGrid grid = facade_grid(plan.buildings[surface.owner], surface);
    return grid.bays * grid.storeys * grid.cell_area();
  }
  const double area = glm::length(glm::cross(surface.edge_u, surface.edge_v));
  return surface.material == Material::gable_wall ? 0.5 * area : area;
}

}  // namespace

CityBuilder::CityBuilder(std::uint64_t seed) : random_(seed, 0) {
  plan_.salt = static_cast<std::uint32_t>(random_.bits());
}

CityPlan CityBuilder::finish() && {
  return std::move(plan_);
}

double CityBuilder::highest_ground(const Rect& rect) const {
  return std::max(std::max(ground(rect.low), ground(rect.high)),
                  std::max(ground({rect.low.x, rect.high.y}), ground({rect.high.x, rect.low.y})));
}

void CityBuilder::add_surface(const Surface& surface) {
  plan_.surfaces.push_back(surface);
  plan_.areas.add(area_of(plan_, surface));
}

void CityBuilder::add_ground(const Rect& rect, Material material) {
  const glm::dvec2 size = rect.high - rect.low;
  add_surface({material, 0, glm::dvec3(rect.low, 0), {size.x, 0, 0}, {0, size.y, 0}});
}

void CityBuilder::add_ground_ring(const Rect& outer, const Rect& inner, Material material) {
  add_ground({outer.low, {outer.high.x, inner.low.y}}, material);
  add_ground({{outer.low.x, inner.low.y}, {inner.low.x, inner.high.y}}, material);
  add_ground({{inner.high.x, inner.low.y}, {outer.high.x, inner.high.y}}, material);
  add_ground({{outer.low.x, inner.high.y}, outer.high}, material);
}

void CityBuilder::add_walls(const Rect& rect, double low, double high, Material material, std::uint32_t owner) {
  const glm::dvec2 size = rect.high - rect.low;
  const glm::dvec3 up(0, 0, high - low);
  add_surface({material, owner, {rect.low.x, rect.low.y, low}, {size.x, 0, 0}, up});
  add_surface({material, owner, {rect.high.x, rect.low.y, low}, {0, size.y, 0}, up});
  add_surface({material, owner, {rect.high.x, rect.high.y, low}, {-size.x, 0, 0}, up});
  add_surface({material, owner, {rect.low.x, rect.high.y, low}, {0, -size.y, 0}, up});
}

void CityBuilder::add_box(const glm::dvec3& low, const glm::dvec3& high, Material material, std::uint32_t owner) {
  add_walls({glm::dvec2(low), glm::dvec2(high)}, low.z, high.z, material, owner);
  add_surface({material, owner, {low.x, low.y, high.z}, {high.x - low.x, 0, 0}, {0, high.y - low.y, 0}});
}

void CityBuilder::add_kerb(const Rect& rect) {
  add_walls(rect, 0, kKerb, Material::kerb, 0);
}

double CityBuilder::add_storeys(const Building& building, const Rect& footprint, double base, int storeys,
                                int first_floor) {
  const auto owner = static_cast<std::uint32_t>(plan_.buildings.size());
  plan_.buildings.push_back(building);
  const double top = base + storeys * building.storey_height;
  if (first_floor == 0) {
    const double lowest =
        std::min(std::min(ground(footprint.low), ground(footprint.high)),
                 std::min(ground({footprint.low.x, footprint.high.y}), ground({footprint.high.x, footprint.low.y})));
    add_walls(footprint, lowest, base, Material::plinth, owner);
  }
  add_walls(footprint, base, top, Material::facade, owner);

  const Rect inside{footprint.low + kInset, footprint.high - kInset};
  const glm::dvec3 along_x(inside.high.x - inside.low.x, 0, 0);
  const glm::dvec3 along_y(0, inside.high.y - inside.low.y, 0);
  for (int k = 0; k < storeys; ++k) {
    const double floor = base + k * building.storey_height;
    if (k >= first_floor) add_surface({Material::floor, owner, glm::dvec3(inside.low, floor), along_x, along_y});
    add_surface(
        {Material::ceiling, owner, glm::dvec3(inside.low, floor + building.storey_height - kSlab), along_y, along_x});
    add_rooms(building, inside, floor, owner);
  }
  return top;
}

// A passage along x through the middle, rooms on both sides.
void CityBuilder::add_rooms(const Building& building, const Rect& inside, double floor, std::uint32_t owner) {
  constexpr double kPassage = 2.0;
  constexpr double kRoom = 5.0;
  const glm::dvec3 up(0, 0, building.storey_height - kSlab);
  const glm::dvec2 size = inside.high - inside.low;
  const double depth = 0.5 * (size.y - kPassage);
  const glm::dvec3 south(inside.low.x, inside.low.y + depth, floor);
  const glm::dvec3 north(inside.low.x, inside.high.y - depth, floor);
  add_surface({Material::partition, owner, south, {size.x, 0, 0}, up});
  add_surface({Material::partition, owner, north, {size.x, 0, 0}, up});
  const int rooms = std::max(2, static_cast<int>(size.x / kRoom));
  for (int i = 1; i < rooms; ++i) {
    const double x = inside.low.x + size.x * i / rooms;
    add_surface({Material::partition, owner, {x, inside.low.y, floor}, {0, depth, 0}, up});
    add_surface({Material::partition, owner, {x, north.y, floor}, {0, depth, 0}, up});
  }
}

void CityBuilder::add_flat_roof(const Rect& footprint, double z) {
  constexpr double kParapetHeight = 0.9;
  constexpr double kParapetWidth = 0.3;
  const auto owner = static_cast<std::uint32_t>(plan_.buildings.size() - 1);
  const Rect roof{footprint.low + kParapetWidth, footprint.high - kParapetWidth};
  const glm::dvec2 size = roof.high - roof.low;
  add_walls(footprint, z, z + kParapetHeight, Material::parapet, owner);
  // With west and east exchanged the walls face inwards
  add_walls({{roof.high.x, roof.low.y}, {roof.low.x, roof.high.y}}, z, z + kParapetHeight, Material::parapet, owner);
  const auto rim = [&](const glm::dvec2& low, const glm::dvec2& high) {
    add_surface({Material::parapet,
                 owner,
                 glm::dvec3(low, z + kParapetHeight),
                 {high.x - low.x, 0, 0},
                 {0, high.y - low.y, 0}});
  };
  rim(footprint.low, {footprint.high.x, roof.low.y});
  rim({footprint.low.x, roof.low.y}, {roof.low.x, roof.high.y});
  rim({roof.high.x, roof.low.y}, {footprint.high.x, roof.high.y});
  rim({footprint.low.x, roof.high.y}, footprint.high);
  add_surface({Material::flat_roof, owner, glm::dvec3(roof.low, z), {size.x, 0, 0}, {0, size.y, 0}});

  const int units = 2 + static_cast<int>(random_.below(4));
  for (int i = 0; i < units; ++i) {
    const glm::dvec2 extent(random_.uniform(1.0, 3.5), random_.uniform(1.0, 3.5));
    const glm::dvec2 low = roof.low + glm::dvec2(random_.uniform(), random_.uniform()) * (size - extent);
    const glm::dvec3 high(low + extent, z + random_.uniform(0.8, 2.8));
    add_box({low.x, low.y, z}, high, Material::roof_unit, owner);
  }
}

void CityBuilder::add_gable_roof(const Rect& footprint, double z) {
  constexpr double kEaves = 0.45;
  constexpr double kPitch = 0.75;  // rise over run
  const auto owner = static_cast<std::uint32_t>(plan_.buildings.size() - 1);
  const glm::dvec2 size = footprint.high - footprint.low;
  // The ridge runs along the longer side
  const bool along_x = size.x > size.y;
  const double length = along_x ? size.x : size.y;
  const double half = 0.5 * (along_x ? size.y : size.x);
  const glm::dvec3 ridge = along_x ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 across = along_x ? glm::dvec3(0, 1, 0) : glm::dvec3(-1, 0, 0);
  const glm::dvec3 middle(0.5 * (footprint.low + footprint.high), z);
  const glm::dvec3 up(0, 0, kPitch * half);
  for (const double side : {-1.0, 1.0}) {
    const double run = half + kEaves;
    const glm::dvec3 along = -side * (length + 2 * kEaves) * ridge;
    const glm::dvec3 eaves = middle + side * run * across - 0.5 * along - glm::dvec3(0, 0, kPitch * kEaves);
    add_surface({Material::gable_roof, owner, eaves, along, -side * run * across + glm::dvec3(0, 0, kPitch * run)});
    const glm::dvec3 corner = middle + 0.5 * side * length * ridge - side * half * across;
    add_surface({Material::gable_wall, owner, corner, 2 * side * half * across, side * half * across + up});
  }
}

void CityBuilder::add_tree(const glm::dvec2& at, double height, Species species) {
  Tree tree;
  tree.species = species;
  tree.foot = glm::dvec3(at, ground(at) + kKerb);
  tree.height = height;
  tree.crown_radius = height * (species == Species::shrub ? 0.5 : 0.3) * random_.uniform(0.85, 1.15);
  tree.salt = static_cast<std::uint32_t>(random_.bits());
  plan_.trees.push_back(tree);
  add_surface({Material::tree, static_cast<std::uint32_t>(plan_.trees.size() - 1)});
}

void CityBuilder::add_car(const glm::dvec2& at, bool along_x) {
  const auto owner = static_cast<std::uint32_t>(random_.bits());
  const double z = ground(at);
  const auto box = [&](double back, double front, double half_width, double low, double high, Material material) {
    const glm::dvec2 a = along_x ? glm::dvec2(back, -half_width) : glm::dvec2(-half_width, back);
    const glm::dvec2 b = along_x ? glm::dvec2(front, half_width) : glm::dvec2(half_width, front);
    add_box(glm::dvec3(at + a, z + low), glm::dvec3(at + b, z + high), material, owner);
  };
  box(-2.15, 2.15, 0.88, 0.12, 0.86, Material::car_body);
  box(-1.6, 0.75, 0.76, 0.86, 1.45, Material::car_cabin);
}

void CityBuilder::add_lamp(const glm::dvec2& foot, const glm::dvec2& head) {
  constexpr double kHeight = 7.0;
  const double z = ground(foot) + kKerb;
  const auto owner = static_cast<std::uint32_t>(plan_.surfaces.size());
  add_box(glm::dvec3(foot - 0.07, z), glm::dvec3(foot + 0.07, z + kHeight), Material::lamp_post, owner);
  add_box(glm::dvec3(glm::min(foot, head) - 0.05, z + kHeight + 0.01),
          glm::dvec3(glm::max(foot, head) + 0.05, z + kHeight + 0.1), Material::lamp_post, owner);
}

}  // namespace stipple::scene
