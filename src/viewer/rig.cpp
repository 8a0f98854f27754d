#include "src/viewer/rig.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/constants.hpp>

namespace stipple {
namespace {

// Half a turn for a drag over the height of the picture.
constexpr double kTurn = glm::pi<double>();
// Of the distance, a notch.
constexpr double kNotch = 0.8;
// Near planes: closer than this there is nothing to see between two cells of the grid.
constexpr double kLeastDistance = 20.0;
// Radii of the cloud: from farther away it is a pixel.
constexpr double kMostDistance = 1000.0;

}  // namespace

void Rig::enter(const WorldBox& box, const Camera& start, double near) {
  box_ = box;
  near_ = near;
  const glm::dvec3 middle = box.empty() ? start.target : 0.5 * (box.min + box.max);
  radius_ = box.empty() ? 1.0 : std::max(0.5 * glm::distance(box.min, box.max), kLeastDistance * near);
  pivot_ = middle;
  place(start);
}

void Rig::place(const Camera& camera) {
  pose_ = pose_of(camera);
  camera_ = camera;
  moved_ = false;
  reach_ = std::max(glm::distance(pose_.eye, pivot_), kLeastDistance * near_);
}

void Rig::set(const Pose& pose) {
  if (pose == pose_) return;
  pose_ = pose;
  moved_ = true;
  camera_ = camera_of(pose_, radius_);
}

void Rig::face(double yaw, double pitch, double aspect) {
  set(facing(box_, yaw, pitch, pose_.fov_deg, aspect));
  pivot_ = box_.empty() ? pivot_ : 0.5 * (box_.min + box_.max);
  reach_ = std::max(glm::distance(pose_.eye, pivot_), kLeastDistance * near_);
}

void Rig::orbit(const glm::dvec2& from, const glm::dvec2& to, const glm::ivec2& size) {
  const glm::dvec2 angle = (from - to) * (kTurn / std::max(size.y, 1));
  set(orbited(pose_, pivot_, angle.x, angle.y));
}

void Rig::turn(const glm::dvec2& from, const glm::dvec2& to, const glm::ivec2& size) {
  const View now = view(size);
  const glm::dvec3 a = ray_through(now, from);
  const glm::dvec3 b = ray_through(now, to);
  // What is under the cursor goes with it, near enough
  const double yaw = std::atan2(a.y, a.x) - std::atan2(b.y, b.x);
  const double pitch = std::atan2(a.z, std::hypot(a.x, a.y)) - std::atan2(b.z, std::hypot(b.x, b.y));
  set(turned(pose_, std::remainder(yaw, glm::two_pi<double>()), pitch));
}

double Rig::pivot_depth() const {
  const double depth = glm::dot(axes_of(pose_).forward, pivot_ - pose_.eye);
  return depth > kLeastDistance * near_ ? depth : reach_;
}

void Rig::pan(const glm::dvec2& from, const glm::dvec2& to, const glm::ivec2& size,
              const std::optional<glm::dvec3>& grabbed) {
  const double depth = grabbed ? glm::dot(axes_of(pose_).forward, *grabbed - pose_.eye) : pivot_depth();
  set(panned(pose_, view(size), std::max(depth, near_), from, to));
}

void Rig::zoom(double notches, const glm::dvec2& place, const glm::ivec2& size,
               const std::optional<glm::dvec3>& point) {
  const glm::dvec3 towards = point ? *point : pose_.eye + pivot_depth() * ray_through(view(size), place);
  set(zoomed(pose_, towards, std::pow(kNotch, notches), kLeastDistance * near_, kMostDistance * radius_));
}

void Rig::fly(const glm::dvec3& direction, double seconds) {
  set(stipple::moved(pose_, direction * (reach_ * seconds)));
}

void Rig::set_ahead(const glm::dvec3& point) {
  reach_ = std::clamp(glm::distance(point, pose_.eye), kLeastDistance * near_, 2.0 * radius_);
}

}  // namespace stipple
