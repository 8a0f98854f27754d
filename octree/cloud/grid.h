// The integer grid on which the positions of one cloud lie.
#pragma once

#include <algorithm>
#include <cstdint>
#include <glm/glm.hpp>
#include <limits>

namespace stipple {

// world = offset + scale * position, per axis, in the cloud's own units. Scale is finite and above zero.
struct Grid {
  glm::dvec3 offset{0.0};
  glm::dvec3 scale{1.0};

  glm::dvec3 world_from_grid(const glm::dvec3& position) const { return offset + scale * position; }
  glm::dvec3 world_from_grid(const glm::ivec3& position) const { return world_from_grid(glm::dvec3(position)); }
  // Fractional and unclamped: a place outside the int32 range is still a place.
  glm::dvec3 grid_from_world(const glm::dvec3& world) const { return (world - offset) / scale; }
};

// Closed box on the grid: both corners belong to it. Default: empty.
struct GridBox {
  glm::ivec3 min{std::numeric_limits<std::int32_t>::max()};
  glm::ivec3 max{std::numeric_limits<std::int32_t>::min()};

  bool empty() const { return min.x > max.x; }
  void extend(const glm::ivec3& p) {
    min = glm::min(min, p);
    max = glm::max(max, p);
  }
  void extend(const GridBox& other) {
    min = glm::min(min, other.min);
    max = glm::max(max, other.max);
  }
  bool contains(const glm::ivec3& p) const {
    return glm::all(glm::lessThanEqual(min, p)) && glm::all(glm::lessThanEqual(p, max));
  }
  bool operator==(const GridBox&) const = default;
};

// Box in world coordinates. Default: empty.
struct WorldBox {
  glm::dvec3 min{std::numeric_limits<double>::infinity()};
  glm::dvec3 max{-std::numeric_limits<double>::infinity()};

  bool empty() const { return !(min.x <= max.x); }
};

inline WorldBox world_box(const Grid& grid, const GridBox& box) {
  return {grid.world_from_grid(box.min), grid.world_from_grid(box.max)};
}

}  // namespace stipple
