// Walls and furniture of the "interior" scene.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "src/scene/solid_tree.h"

namespace stipple::scene {

// Inside of the outer walls, in metres; the ground floor lies at 0.
constexpr glm::vec3 kHouseSize{40.0f, 24.0f, 6.9f};
constexpr float kUpperFloor = 3.6f;

// Closed all round: windows have panes, the entrance is shut.
std::vector<Solid> furnish_house(std::uint64_t seed);

}  // namespace stipple::scene
