// What lies on the ground of the "city" scene.
#pragma once

#include <glm/glm.hpp>

#include "src/scene/city_plan.h"

namespace stipple::scene {

// Asphalt with lane marks, crossings, parking bays and manholes. Marks follow from the place in the grid of roads.
glm::vec3 road_colour(const glm::dvec2& at, std::uint32_t salt);

// Colour of a surface of Material::pavement, yard or park.
glm::vec3 ground_colour(Material material, const glm::dvec2& at, std::uint32_t salt);

}  // namespace stipple::scene
