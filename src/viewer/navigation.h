// How a camera moves: pure geometry, no window.
#pragma once

#include <glm/glm.hpp>

#include "octree/cloud/grid.h"
#include "render/frame/camera.h"

namespace stipple {

// Where the eye is and how it looks. z is up, the horizon level: there is no roll. Angles in radians.
struct Pose {
  glm::dvec3 eye{0.0};
  double yaw = 0.0;    // from +x towards +y
  double pitch = 0.0;  // above the horizon, -pi/2 to pi/2
  double fov_deg = 60.0;

  bool operator==(const Pose&) const = default;
};

struct Axes {
  glm::dvec3 right;
  glm::dvec3 up;
  glm::dvec3 forward;
};

// Orthonormal also straight up and down, where yaw says what is up in the picture.
Axes axes_of(const Pose& pose);

// The target is `distance` ahead.
Camera camera_of(const Pose& pose, double distance);
// Drops roll.
Pose pose_of(const Camera& camera);

// From the eye through this place of the picture, in pixels from the upper left corner; one unit of it is one of depth.
glm::dvec3 ray_through(const View& view, const glm::dvec2& pixel);

// Turns around `pivot`, which stays where it is in the picture, and as far from the eye.
Pose orbited(const Pose& pose, const glm::dvec3& pivot, double yaw, double pitch);

// Turns the head.
Pose turned(const Pose& pose, double yaw, double pitch);

// Moves so that what was seen in `from` at `depth` is seen in `to`. `view` is that of the pose.
Pose panned(const Pose& pose, const View& view, double depth, const glm::dvec2& from, const glm::dvec2& to);

// Moves along the line to `point`, which stays where it is in the picture, to `factor` times the distance, but neither
// nearer than `least` nor, going away, farther than `most`.
Pose zoomed(const Pose& pose, const glm::dvec3& point, double factor, double least, double most);

// Moves by `step` along right, up and forward.
Pose moved(const Pose& pose, const glm::dvec3& step);

// Looks in this direction from where the whole box fills the picture. `aspect` is width over height.
Pose facing(const WorldBox& box, double yaw, double pitch, double fov_deg, double aspect);

}  // namespace stipple
