#include "src/viewer/navigation.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace stipple {
namespace {

constexpr double kUpright = glm::half_pi<double>();

}  // namespace

Axes axes_of(const Pose& pose) {
  const double sy = std::sin(pose.yaw);
  const double cy = std::cos(pose.yaw);
  const double sp = std::sin(pose.pitch);
  const double cp = std::cos(pose.pitch);
  return {.right = {sy, -cy, 0.0}, .up = {-sp * cy, -sp * sy, cp}, .forward = {cp * cy, cp * sy, sp}};
}

Camera camera_of(const Pose& pose, double distance) {
  const Axes axes = axes_of(pose);
  // Straight up and down only the pose knows what is up; elsewhere it is z, which reads better in a command line
  const bool level = std::abs(axes.forward.z) < 0.999;
  return {.eye = pose.eye,
          .target = pose.eye + distance * axes.forward,
          .up = level ? glm::dvec3(0.0, 0.0, 1.0) : axes.up,
          .fov_deg = pose.fov_deg};
}

Pose pose_of(const Camera& camera) {
  const View view = make_view(camera, {1, 1}, 1.0);
  // Near the poles the line of sight hardly says where yaw points, but what is up in the picture does
  const glm::dvec3 ahead = view.forward - view.up * view.forward.z;
  return {.eye = camera.eye,
          .yaw = std::atan2(ahead.y, ahead.x),
          .pitch = std::asin(std::clamp(view.forward.z, -1.0, 1.0)),
          .fov_deg = camera.fov_deg};
}

glm::dvec3 ray_through(const View& view, const glm::dvec2& pixel) {
  const double x = 2.0 * pixel.x / view.size.x - 1.0;
  const double y = 1.0 - 2.0 * pixel.y / view.size.y;
  return view.forward + view.right * (x / view.cot_x) + view.up * (y / view.cot_y);
}

Pose turned(const Pose& pose, double yaw, double pitch) {
  Pose next = pose;
  next.yaw = std::remainder(pose.yaw + yaw, glm::two_pi<double>());
  next.pitch = std::clamp(pose.pitch + pitch, -kUpright, kUpright);
  return next;
}

Pose orbited(const Pose& pose, const glm::dvec3& pivot, double yaw, double pitch) {
  const Axes before = axes_of(pose);
  const glm::dvec3 r = pivot - pose.eye;
  Pose next = turned(pose, yaw, pitch);
  const Axes after = axes_of(next);
  next.eye = pivot - after.right * glm::dot(before.right, r) - after.up * glm::dot(before.up, r) -
             after.forward * glm::dot(before.forward, r);
  return next;
}

Pose panned(const Pose& pose, const View& view, double depth, const glm::dvec2& from, const glm::dvec2& to) {
  Pose next = pose;
  next.eye += depth * (ray_through(view, from) - ray_through(view, to));
  return next;
}

Pose zoomed(const Pose& pose, const glm::dvec3& point, double factor, double least, double most) {
  const glm::dvec3 away = pose.eye - point;
  const double distance = glm::length(away);
  if (distance == 0.0) return pose;
  const double wanted = distance * factor;
  const double next_distance =
      factor < 1.0 ? std::max(wanted, std::min(least, distance)) : std::min(wanted, std::max(most, distance));
  Pose next = pose;
  next.eye = point + away * (next_distance / distance);
  return next;
}

Pose moved(const Pose& pose, const glm::dvec3& step) {
  const Axes axes = axes_of(pose);
  Pose next = pose;
  next.eye += axes.right * step.x + axes.up * step.y + axes.forward * step.z;
  return next;
}

Pose facing(const WorldBox& box, double yaw, double pitch, double fov_deg, double aspect) {
  Pose pose{.yaw = yaw, .pitch = pitch, .fov_deg = fov_deg};
  const glm::dvec3 middle = box.empty() ? glm::dvec3(0.0) : 0.5 * (box.min + box.max);
  const glm::dvec3 half = box.empty() ? glm::dvec3(0.5) : 0.5 * (box.max - box.min);
  const Axes axes = axes_of(pose);
  const double cot_y = 1.0 / std::tan(0.5 * glm::radians(fov_deg));
  const double cot_x = cot_y / aspect;
  // A corner is in the picture while its place across, times cot, is at most its depth
  constexpr double kMargin = 1.03;
  double distance = 0.0;
  for (int c = 0; c < 8; ++c) {
    const glm::dvec3 r = kMargin * half * glm::dvec3(c & 1 ? 1 : -1, c & 2 ? 1 : -1, c & 4 ? 1 : -1);
    const double across = std::max(std::abs(glm::dot(axes.right, r)) * cot_x, std::abs(glm::dot(axes.up, r)) * cot_y);
    distance = std::max(distance, across - glm::dot(axes.forward, r));
  }
  pose.eye = middle - axes.forward * (distance > 0.0 ? distance : 1.0);
  return pose;
}

}  // namespace stipple
