#include "octree/select/density.h"

#include <algorithm>
#include <cmath>

namespace stipple {

double estimated_pixels(const BoxCounts& profile, double root_edge, double pixel_size) {
  const auto& occupied = profile.occupied;
  if (occupied[0] == 0) return 0.0;
  const double level = std::clamp(std::log2(root_edge / pixel_size), 0.0, double{kMaxLevel});
  double pixels = 1.0;
  for (int finer = 1; finer < level + 1.0; ++finer) {
    const double cells = occupied[finer - 1];
    const double missed = std::max(0.0, 1.0 - occupied[finer] / cells / 4.0);  // of a pixel's quarters by one cell
    const double growth = 4.0 * (1.0 - std::pow(missed, cells / pixels));
    pixels *= std::pow(growth, std::min(1.0, level - (finer - 1)));
  }
  return pixels;
}

double uniform_pixels(const WorldBox& box, std::size_t count, const glm::dvec3& direction, double pixel_size) {
  if (count == 0) return 0.0;
  const glm::dvec3 size = box.max - box.min;
  const glm::dvec3 faces(size.y * size.z, size.x * size.z, size.x * size.y);
  const double outline = glm::dot(glm::abs(direction), faces) / (pixel_size * pixel_size);
  return std::clamp(outline, 1.0, static_cast<double>(count));
}

}  // namespace stipple
