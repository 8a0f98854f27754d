#include "render/frame/propose_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace stipple {
namespace {

constexpr double kFovDeg = 60.0;

// At most 200,000 points, evenly through the set, in world coordinates.
std::vector<glm::dvec3> sample_of(const PointSet& set) {
  const std::size_t step = std::max<std::size_t>(1, set.size() / 200'000);
  std::vector<glm::dvec3> sample;
  for (std::size_t i = 0; i < set.size(); i += step) sample.push_back(set.grid.world_from_grid(set.points[i].position));
  return sample;
}

double percentile(std::vector<double>& values, double part) {
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// Holds all but the outermost half percent along each axis.
WorldBox robust_box(const std::vector<glm::dvec3>& sample) {
  WorldBox box{glm::dvec3(0.0), glm::dvec3(0.0)};
  if (sample.empty()) return box;
  std::vector<double> values(sample.size());
  for (int axis = 0; axis < 3; ++axis) {
    std::ranges::transform(sample, values.begin(), [axis](const glm::dvec3& p) { return p[axis]; });
    box.min[axis] = percentile(values, 0.005);
    box.max[axis] = percentile(values, 0.995);
  }
  return box;
}

// Looks at the middle of the box from this azimuth and elevation, just far enough to see all its corners.
Camera looking_at(const WorldBox& box, double azimuth_deg, double elevation_deg, double aspect) {
  const double azimuth = glm::radians(azimuth_deg);
  const double elevation = glm::radians(elevation_deg);
  const glm::dvec3 back(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                        std::sin(elevation));
  Camera camera;
  camera.fov_deg = kFovDeg;
  camera.target = 0.5 * (box.min + box.max);
  camera.eye = camera.target + back;
  const View view = make_view(camera, {1000, std::max(1, static_cast<int>(1000.0 / aspect))}, 1.0);
  double distance = 0.0;
  for (int corner = 0; corner < 8; ++corner) {
    const glm::dvec3 p(corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                       corner & 4 ? box.max.z : box.min.z);
    const glm::dvec3 r = p - camera.target;
    const double needed = std::max(std::abs(glm::dot(view.right, r)) * view.cot_x, std::abs(glm::dot(view.up, r)) * view.cot_y);
    distance = std::max(distance, needed - glm::dot(view.forward, r));
  }
  constexpr double kMargin = 1.02;
  camera.eye = camera.target + back * (distance > 0.0 ? kMargin * distance : 1.0);
  return camera;
}

// From a quarter of the way along the diagonal, above what stands around, towards the middle of the ground.
Camera low_over(const WorldBox& box, const std::vector<glm::dvec3>& sample) {
  const glm::dvec3 extent = box.max - box.min;
  const double width = std::max(extent.x, extent.y);
  Camera camera;
  camera.fov_deg = kFovDeg;
  camera.eye = {box.min.x + 0.25 * extent.x, box.min.y + 0.25 * extent.y, box.min.z};
  double top = box.min.z;
  for (const glm::dvec3& p : sample)
    if (glm::distance(glm::dvec2(p), glm::dvec2(camera.eye)) < 0.03 * width && p.z <= box.max.z) top = std::max(top, p.z);
  camera.eye.z = top + 0.02 * width;
  camera.target = {box.max.x - 0.4 * extent.x, box.max.y - 0.4 * extent.y, box.min.z + 0.2 * extent.z};
  if (camera.eye == camera.target) camera.target.y += 1.0;
  return camera;
}

}  // namespace

std::vector<NamedCamera> propose_cameras(const PointSet& points, double aspect) {
  const std::vector<glm::dvec3> sample = sample_of(points);
  const WorldBox box = robust_box(sample);
  return {{"oblique", looking_at(box, 235.0, 30.0, aspect)},
          {"aerial", looking_at(box, 265.0, 75.0, aspect)},
          {"low", low_over(box, sample)}};
}

}  // namespace stipple
