#include "octree/build/morton.h"

namespace stipple {

RootCube root_cube(const Grid& grid, const GridBox& bounds) {
  if (bounds.empty()) return {};
  const glm::dvec3 steps = glm::dvec3(bounds.max) - glm::dvec3(bounds.min) + 1.0;
  const glm::dvec3 extent = steps * grid.scale;
  return {grid.world_from_grid(bounds.min), std::max({extent.x, extent.y, extent.z})};
}

Quantizer::Quantizer(const Grid& grid, const GridBox& bounds)
    : origin_(bounds.min), cells_per_step_(grid.scale / root_cube(grid, bounds).edge * double{kFinestCells}) {}

}  // namespace stipple
