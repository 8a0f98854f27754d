#include "octree/select/frustum.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stipple {
namespace {

// Of the distance to the eye. Single precision rounds to 6e-8; projecting does so a few times.
constexpr double kSinglePrecisionSlack = 1e-6;
// Of the magnitude of coordinates: world = offset + scale * cell rounds twice, taking differences once more.
constexpr double kDoublePrecisionSlack = 8 * std::numeric_limits<double>::epsilon();

}  // namespace

Frustum make_frustum(const glm::dvec3& eye, const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& forward,
                     double half_angle_x, double half_angle_y) {
  const double cos_x = std::cos(half_angle_x), sin_x = std::sin(half_angle_x);
  const double cos_y = std::cos(half_angle_y), sin_y = std::sin(half_angle_y);
  return {eye,
          {forward * sin_x + right * cos_x, forward * sin_x - right * cos_x, forward * sin_y + up * cos_y,
           forward * sin_y - up * cos_y, forward},
          glm::dvec3(0.0)};
}

bool may_see(const Frustum& frustum, const WorldBox& box) {
  if (box.empty()) return false;
  const glm::dvec3 magnitude = glm::max(glm::abs(box.min), glm::abs(box.max)) + glm::abs(frustum.eye);
  const double rounding = kDoublePrecisionSlack * (magnitude.x + magnitude.y + magnitude.z);
  const double aside = glm::length(frustum.to_side);
  for (const glm::dvec3& inward : frustum.inward) {
    // The corner farthest along the normal; when even that one is outside, so is the box.
    const glm::dvec3 corner = glm::mix(box.min, box.max, glm::greaterThan(inward, glm::dvec3(0.0)));
    const glm::dvec3 from_eye = corner - frustum.eye;
    const double slack = kSinglePrecisionSlack * (glm::length(from_eye) + aside) + rounding;
    // Seen from the eye that the plane is farther behind
    if (glm::dot(inward, from_eye) + std::abs(glm::dot(inward, frustum.to_side)) < -slack) return false;
  }
  return true;
}

double nearest_distance(const glm::dvec3& eye, const WorldBox& box) {
  return glm::distance(eye, glm::clamp(eye, box.min, box.max));
}

double nearest_distance(const Frustum& frustum, const WorldBox& box) {
  if (frustum.to_side == glm::dvec3(0.0)) return nearest_distance(frustum.eye, box);
  return std::min(nearest_distance(frustum.eye - frustum.to_side, box),
                  nearest_distance(frustum.eye + frustum.to_side, box));
}

double farthest_distance(const glm::dvec3& eye, const WorldBox& box) {
  return glm::length(glm::max(glm::abs(box.min - eye), glm::abs(box.max - eye)));
}

double nearest_depth(const glm::dvec3& eye, const glm::dvec3& forward, const WorldBox& box) {
  const glm::dvec3 corner = glm::mix(box.min, box.max, glm::lessThan(forward, glm::dvec3(0.0)));
  return glm::dot(forward, corner - eye);
}

}  // namespace stipple
