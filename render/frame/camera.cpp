#include "render/frame/camera.h"

#include <fmt/format.h>

#include <cmath>
#include <glm/gtc/constants.hpp>

#include "octree/core/error.h"

namespace stipple {
namespace {

// Sine of the angle under which `up` counts as parallel to the line of sight: below it the basis would lose more than
// ten of a double's sixteen digits to cancellation.
constexpr double kParallelSine = 1e-6;

std::string text_of(const glm::dvec3& v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

// The axis with the smallest share of `forward`. Among equals z before y before x: straight down shows y upwards, as
// maps do.
glm::dvec3 axis_farthest_from(const glm::dvec3& forward) {
  const glm::dvec3 share = glm::abs(forward);
  if (share.z <= share.x && share.z <= share.y) return {0.0, 0.0, 1.0};
  return share.y <= share.x ? glm::dvec3{0.0, 1.0, 0.0} : glm::dvec3{1.0, 0.0, 0.0};
}

glm::dvec3 line_of_sight(const Camera& camera) {
  const glm::dvec3 path = camera.target - camera.eye;
  const double distance = glm::length(path);
  if (distance == 0.0)
    throw UsageError(fmt::format("camera: eye and target coincide at {}; move one of them", text_of(camera.eye)));
  if (!std::isfinite(distance))
    throw UsageError(fmt::format("camera: eye {} and target {} must be finite and less than 1e150 apart",
                                 text_of(camera.eye), text_of(camera.target)));
  return path / distance;
}

glm::dvec3 right_of(const glm::dvec3& forward, const glm::dvec3& up) {
  const glm::dvec3 side = glm::cross(forward, up);
  const double sine = glm::length(side) / glm::length(up);
  if (sine > kParallelSine && std::isfinite(sine)) return glm::normalize(side);
  return glm::normalize(glm::cross(forward, axis_farthest_from(forward)));
}

}  // namespace

View View::of_eye(std::size_t number) const {
  View view = *this;
  if (eyes() == 2) view.eye += right * (number == 0 ? -0.5 * eyes_apart : 0.5 * eyes_apart);
  view.eyes_apart = 0.0;
  return view;
}

View make_view(const Camera& camera, const glm::ivec2& size, double near) {
  if (!(camera.fov_deg > 0.0 && camera.fov_deg < 180.0))
    throw UsageError(
        fmt::format("camera: the field of view is {} degrees; it must be above 0 and below 180", camera.fov_deg));
  if (size.x <= 0 || size.y <= 0)
    throw UsageError(fmt::format("image size {}x{}: both must be above 0 pixels", size.x, size.y));
  if (!(near > 0.0 && std::isfinite(near)))
    throw UsageError(fmt::format("camera: the near distance is {}; it must be above 0", near));

  View view;
  view.eye = camera.eye;
  view.forward = line_of_sight(camera);
  view.right = right_of(view.forward, camera.up);
  view.up = glm::cross(view.right, view.forward);
  view.cot_y = 1.0 / std::tan(camera.fov_deg * (glm::pi<double>() / 360.0));
  view.cot_x = view.cot_y * size.y / size.x;
  view.near = near;
  view.size = size;
  return view;
}

}  // namespace stipple
