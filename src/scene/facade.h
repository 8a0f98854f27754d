// Facades of the "city" scene: windows set back into walls of brick, plaster, panels or glass.
#pragma once

#include <glm/glm.hpp>

#include "src/scene/city_plan.h"
#include "src/scene/random.h"

namespace stipple::scene {

// Colour of the wall without windows at (u, v) metres.
glm::vec3 wall_colour(const Building& building, double u, double v);

// A random point of a surface of Material::facade, its windows and their reveals.
ScenePoint sample_facade(const Building& building, const Surface& surface, PointRandom& random);

}  // namespace stipple::scene
