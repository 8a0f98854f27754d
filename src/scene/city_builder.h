// Adds streets, buildings and furniture to the plan of a city, surface by surface.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "src/scene/city_plan.h"
#include "src/scene/random.h"

namespace stipple::scene {

// An upright rectangle on the ground plan, in metres.
struct Rect {
  glm::dvec2 low;
  glm::dvec2 high;
};

class CityBuilder {
 public:
  explicit CityBuilder(std::uint64_t seed);

  // The dice of the plan: whoever draws must do so in a fixed order.
  PointRandom& random() { return random_; }

  double ground(const glm::dvec2& at) const { return city_ground(at.x, at.y, plan_.salt); }
  // The highest corner.
  double highest_ground(const Rect& rect) const;

  void add_ground(const Rect& rect, Material material);
  // What lies in `outer` but not in `inner`, in four pieces.
  void add_ground_ring(const Rect& outer, const Rect& inner, Material material);
  // The upright faces around `rect`.
  void add_kerb(const Rect& rect);

  // A building from `base` up: facades, plinth where it stands on the ground, floors from storey `first_floor` up,
  // ceilings and inner walls. Returns the height of its top. The roofs below belong to the building added last.
  double add_storeys(const Building& building, const Rect& footprint, double base, int storeys, int first_floor);
  void add_flat_roof(const Rect& footprint, double z);
  void add_gable_roof(const Rect& footprint, double z);

  void add_tree(const glm::dvec2& at, double height, Species species);
  void add_car(const glm::dvec2& at, bool along_x);
  // A post at `foot` with its light over `head`.
  void add_lamp(const glm::dvec2& foot, const glm::dvec2& head);

  CityPlan finish() &&;

 private:
  void add_surface(const Surface& surface);
  // Sides and top.
  void add_box(const glm::dvec3& low, const glm::dvec3& high, Material material, std::uint32_t owner);
  void add_walls(const Rect& rect, double low, double high, Material material, std::uint32_t owner);
  void add_rooms(const Building& building, const Rect& inside, double floor, std::uint32_t owner);

  PointRandom random_;
  CityPlan plan_;
};

}  // namespace stipple::scene
