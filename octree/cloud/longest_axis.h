// Along which axis a box is longest.
#pragma once

#include "octree/cloud/grid.h"

namespace stipple {

// In world units: 0, 1 or 2 for x, y or z, the first of equal ones.
inline int longest_axis(const Grid& grid, const GridBox& box) {
  const glm::dvec3 size = (glm::dvec3(box.max) - glm::dvec3(box.min)) * grid.scale;
  if (size.x >= size.y && size.x >= size.z) return 0;
  return size.y >= size.z ? 1 : 2;
}

}  // namespace stipple
