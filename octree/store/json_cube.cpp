#include "octree/store/json_cube.h"

#include <fmt/format.h>

#include <algorithm>

namespace stipple {
namespace {

constexpr double kWidestCube = 1e300;

}  // namespace

void check_cube(const WorldBox& box, const JsonValue& json) {
  const glm::dvec3 size = box.max - box.min;
  const double edge = std::max({size.x, size.y, size.z});
  const double shortest = std::min({size.x, size.y, size.z});
  const glm::dvec3 magnitude = glm::max(glm::abs(box.min), glm::abs(box.max));
  // A million times the rounding of a double; a writer with floats would still be within it
  const double tolerance = 1e-6 * edge + 1e-9 * std::max({magnitude.x, magnitude.y, magnitude.z});
  if (shortest < 0.0) throw json.error("no maximum was expected to be below its minimum.");
  if (!(edge < kWidestCube) || edge - shortest > tolerance)
    throw json.error(fmt::format("{} x {} x {} was found, and a cube was expected.", size.x, size.y, size.z));
}

}  // namespace stipple
