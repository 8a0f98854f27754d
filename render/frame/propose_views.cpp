#include "render/frame/propose_views.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <tuple>

namespace stipple {
namespace {

constexpr double kFovDeg = 60.0;

// At most 200,000 points in world coordinates, chosen by id: the same ones in whatever order the points stand, so that
// all methods propose the same cameras.
std::vector<glm::dvec3> sample_of(const PointSet& set) {
  const std::size_t step = std::max<std::size_t>(1, set.size() / 200'000);
  std::vector<glm::dvec3> sample;
  for (std::size_t i = 0; i < set.size(); ++i)
    if (set.id(i) % step == 0) sample.push_back(set.grid.world_from_grid(set.points[i].position));
  return sample;
}

// Rounded outwards: of a few values none is left out.
double percentile(std::vector<double>& values, double part) {
  const double place = part * static_cast<double>(values.size() - 1);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(part < 0.5 ? std::floor(place) : std::ceil(place));
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

using Corners = std::array<glm::dvec3, 8>;  // across (x, y), already times cot, and forward (z), relative to the middle

// Where across an eye `ahead` of the middle must stand so that the corners reach equally far to both sides of its
// picture, along x (axis 0) or y (axis 1); in units of across.
double centred(const Corners& corners, double ahead, int axis) {
  double low = corners[0][axis];
  double high = low;
  for (const glm::dvec3& corner : corners) {
    low = std::min(low, corner[axis]);
    high = std::max(high, corner[axis]);
  }
  // The sum of the two ends in the picture falls as the eye moves up
  for (int step = 0; step < 60; ++step) {
    const double place = 0.5 * (low + high);
    double least = std::numeric_limits<double>::infinity();
    double most = -least;
    for (const glm::dvec3& corner : corners) {
      const double in_picture = (corner[axis] - place) / (corner.z - ahead);
      least = std::min(least, in_picture);
      most = std::max(most, in_picture);
    }
    (least + most > 0.0 ? low : high) = place;
  }
  return 0.5 * (low + high);
}

// Looks at the box from this azimuth and elevation, so near that its corners touch the borders of the picture, centred.
// A corner is in the picture of an eye while |corner across - eye across| <= corner forward - eye forward: two bounds
// on eye forward plus and minus eye across. The eye goes as far forward as all allow.
Camera looking_at(const WorldBox& box, double azimuth_deg, double elevation_deg, double aspect, double cell) {
  const double azimuth = glm::radians(azimuth_deg);
  const double elevation = glm::radians(elevation_deg);
  const glm::dvec3 forward(-std::cos(elevation) * std::cos(azimuth), -std::cos(elevation) * std::sin(azimuth),
                           -std::sin(elevation));
  const glm::dvec3 middle = 0.5 * (box.min + box.max);
  const View view = make_view({.eye = middle - forward, .target = middle, .fov_deg = kFovDeg},
                              {1000, std::max(1, static_cast<int>(1000.0 / aspect))}, 1.0);

  constexpr double kMargin = 1.03;
  Corners corners;
  glm::dvec2 plus(std::numeric_limits<double>::infinity());
  glm::dvec2 minus = plus;
  for (std::size_t c = 0; c < corners.size(); ++c) {
    const glm::dvec3 r =
        0.5 * kMargin * (box.max - box.min) * glm::dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
    corners[c] = {glm::dot(view.right, r) * view.cot_x, glm::dot(view.up, r) * view.cot_y, glm::dot(forward, r)};
    plus = glm::min(plus, corners[c].z + glm::dvec2(corners[c]));
    minus = glm::min(minus, corners[c].z - glm::dvec2(corners[c]));
  }
  double ahead = 0.5 * std::min(plus.x + minus.x, plus.y + minus.y);
  if (!(ahead < 0.0)) ahead = -1.0;  // a box without extent
  // The near plane is a cell away
  for (const glm::dvec3& corner : corners) ahead = std::min(ahead, corner.z - 2.0 * cell);

  Camera camera;
  camera.fov_deg = kFovDeg;
  camera.target = middle + view.right * (centred(corners, ahead, 0) / view.cot_x) +
                  view.up * (centred(corners, ahead, 1) / view.cot_y);
  camera.eye = camera.target + forward * ahead;
  return camera;
}

// From above the points nearest to a quarter of the way along the diagonal, towards the middle, slightly down. Height
// and distance follow from how far apart the points are there, so that a narrow strip is seen from as near as a field
// is.
Camera low_over(const WorldBox& box, const std::vector<glm::dvec3>& sample) {
  Camera camera;
  camera.fov_deg = kFovDeg;
  if (sample.empty()) return camera;
  const glm::dvec3 quarter = box.min + 0.25 * (box.max - box.min);
  const auto nearer_to = [](const glm::dvec2& place) {
    return [place](const glm::dvec3& a, const glm::dvec3& b) {
      // Columns stand at equal distance: their points need an order, too
      return std::tuple(glm::distance(glm::dvec2(a), place), a.x, a.y, a.z) <
             std::tuple(glm::distance(glm::dvec2(b), place), b.x, b.y, b.z);
    };
  };
  const glm::dvec3 here = *std::ranges::min_element(sample, nearer_to(glm::dvec2(quarter)));

  // Its neighbourhood: one point in 500, but at least 8
  std::vector<glm::dvec3> around = sample;
  const std::size_t count = std::min(around.size(), std::max<std::size_t>(8, around.size() / 500));
  const auto last = around.begin() + static_cast<std::ptrdiff_t>(count - 1);
  std::nth_element(around.begin(), last, around.end(), nearer_to(glm::dvec2(here)));
  const double radius = glm::distance(glm::dvec2(*last), glm::dvec2(here));
  double low = here.z;
  double high = here.z;
  for (auto p = around.begin(); p <= last; ++p) {
    low = std::min(low, p->z);
    if (p->z <= box.max.z) high = std::max(high, p->z);
  }

  glm::dvec2 ahead = glm::dvec2(0.5 * (box.min + box.max) - here);
  ahead = glm::length(ahead) > 0.0 ? glm::normalize(ahead) : glm::dvec2(0.0, 1.0);
  const double reach = std::max(radius, 1e-3 * glm::length(box.max - box.min));
  camera.eye = {here.x, here.y, high + 0.6 * (reach > 0.0 ? reach : 1.0)};
  camera.target = {glm::dvec2(here) + 8.0 * (reach > 0.0 ? reach : 1.0) * ahead, low};
  return camera;
}

}  // namespace

std::vector<NamedCamera> propose_cameras(const PointSet& points, double aspect) {
  const std::vector<glm::dvec3> sample = sample_of(points);
  const WorldBox box = robust_box(sample);
  const double cell = std::min({points.grid.scale.x, points.grid.scale.y, points.grid.scale.z});
  return {{"oblique", looking_at(box, 235.0, 30.0, aspect, cell)},
          {"aerial", looking_at(box, 265.0, 75.0, aspect, cell)},
          {"low", low_over(box, sample)}};
}

WorldBox robust_bounds(const PointSet& points) {
  return robust_box(sample_of(points));
}

}  // namespace stipple
