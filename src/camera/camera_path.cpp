#include "src/camera/camera_path.h"

#include <algorithm>

namespace stipple {
namespace {

using Vector = glm::dvec3 Camera::*;

// Slope at a key: of the parabola through it and its neighbours; at an end, of the line to its only one.
glm::dvec3 tangent(const std::vector<TimedCamera>& keys, std::size_t i, Vector part) {
  const auto slope = [&](std::size_t a, std::size_t b) {
    return (keys[b].camera.*part - keys[a].camera.*part) / (keys[b].seconds - keys[a].seconds);
  };
  if (i == 0) return slope(0, 1);
  if (i + 1 == keys.size()) return slope(i - 1, i);
  const double before = keys[i].seconds - keys[i - 1].seconds;
  const double after = keys[i + 1].seconds - keys[i].seconds;
  return (slope(i - 1, i) * after + slope(i, i + 1) * before) / (before + after);
}

// Cubic Hermite between keys i and i + 1 at `t` of the way.
glm::dvec3 between(const std::vector<TimedCamera>& keys, std::size_t i, double t, Vector part) {
  const double span = keys[i + 1].seconds - keys[i].seconds;
  const double t2 = t * t;
  const double t3 = t2 * t;
  return (2 * t3 - 3 * t2 + 1) * (keys[i].camera.*part) + (t3 - 2 * t2 + t) * span * tangent(keys, i, part) +
         (3 * t2 - 2 * t3) * (keys[i + 1].camera.*part) + (t3 - t2) * span * tangent(keys, i + 1, part);
}

}  // namespace

Camera camera_at(const CameraPath& path, double seconds) {
  const std::vector<TimedCamera>& keys = path.keys;
  if (seconds <= keys.front().seconds) return keys.front().camera;
  if (seconds >= keys.back().seconds) return keys.back().camera;
  const auto next = std::ranges::upper_bound(keys, seconds, {}, &TimedCamera::seconds);
  const auto i = static_cast<std::size_t>(next - keys.begin()) - 1;
  const double t = (seconds - keys[i].seconds) / (keys[i + 1].seconds - keys[i].seconds);
  const Camera& a = keys[i].camera;
  const Camera& b = keys[i + 1].camera;
  return {.eye = between(keys, i, t, &Camera::eye),
          .target = between(keys, i, t, &Camera::target),
          .up = (1.0 - t) * a.up + t * b.up,
          .fov_deg = (1.0 - t) * a.fov_deg + t * b.fov_deg};
}

std::vector<Camera> cameras_along(const CameraPath& path, int count) {
  std::vector<Camera> cameras;
  for (int i = 0; i < count; ++i)
    cameras.push_back(camera_at(path, path.start() + path.duration() * i / std::max(1, count - 1)));
  return cameras;
}

CameraPath propose_path(const std::vector<NamedCamera>& proposed) {
  const Camera& from = proposed.front().camera;
  const Camera& to = proposed.back().camera;
  Camera halfway = from;
  halfway.eye = 0.5 * (from.eye + to.eye);
  halfway.target = 0.5 * (from.target + to.target);
  return {"approach", {{0.0, from}, {2.4, halfway}}};
}

}  // namespace stipple
