// The relief of the "terrain" scene: hills, a river, fields.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

namespace stipple::scene {

constexpr double kTerrainSize = 4000.0;  // metres, both ways

struct Relief {
  double height = 0.0;  // metres, 18 to 1220; peaks are mostly below 900
  glm::vec3 normal{0, 0, 1};
  float valley = 0.0f;    // 1 on the valley floor, 0 in the hills
  double to_river = 0.0;  // metres to its centre line
  double depth = 0.0;     // of the water; 0 on dry land
};

Relief relief_at(const glm::dvec2& at, std::uint32_t salt);

}  // namespace stipple::scene
