// Colours of surfaces, as functions of a place on the surface in metres. All are 0 to 1 and unlit; `salt` sets apart
// what should not repeat.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace stipple::scene {

// Light on a diffuse surface under a fixed sun in the south-west and a bright sky; 0.35 to 1.15. `normal` is of
// length 1.
float sunlight(const glm::vec3& normal);

float luminance(const glm::vec3& colour);

// Stains, streaks and grain down to 2 cm.
glm::vec3 plaster(double u, double v, const glm::vec3& base, std::uint32_t salt);
// Running bond: bricks of 25 cm x 8 cm, mortar of 12 mm.
glm::vec3 brick_wall(double u, double v, const glm::vec3& base, std::uint32_t salt);
// Square slabs `size` wide with joints of 1 cm.
glm::vec3 paving(double u, double v, double size, const glm::vec3& base, std::uint32_t salt);
// Rows of 30 cm, tiles of 24 cm; v runs up the slope.
glm::vec3 roof_tiles(double u, double v, const glm::vec3& base, std::uint32_t salt);
// Boards along u, 14 cm wide and 1.6 m long.
glm::vec3 boards(double u, double v, const glm::vec3& base, std::uint32_t salt);
// Patches, cracks and chippings.
glm::vec3 asphalt(double u, double v, std::uint32_t salt);
// Patches of 12 m down to tufts of 10 cm.
glm::vec3 grass(double u, double v, std::uint32_t salt);
// Fallen leaves, moss and soil.
glm::vec3 forest_floor(double u, double v, std::uint32_t salt);

}  // namespace stipple::scene
