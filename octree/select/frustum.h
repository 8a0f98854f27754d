// What a view can see, and how far away it is.
#pragma once

#include <array>
#include <glm/glm.hpp>

#include "octree/cloud/grid.h"

namespace stipple {

// The infinite pyramid that starts at the eye: four sides, and the plane through the eye that parts before from behind.
// Everything in world units and directions. For two eyes that look in the same direction, what either of them sees, and
// what lies between that.
struct Frustum {
  glm::dvec3 eye{0.0};                 // or the middle of two
  std::array<glm::dvec3, 5> inward{};  // unit normals of planes through the eye
  glm::dvec3 to_side{0.0};             // from the middle to one of two eyes; 0: there is one
};

// `right`, `up`, `forward`: orthonormal. Half angles between the forward direction and the sides, in radians, in
// (0, pi/2).
Frustum make_frustum(const glm::dvec3& eye, const glm::dvec3& right, const glm::dvec3& up, const glm::dvec3& forward,
                     double half_angle_x, double half_angle_y);

// False only when no point of the box can be seen. Never wrongly so: allows for the rounding of world coordinates, and
// for shaders that decide in single precision whether a point on the border is in the picture. May be true for a box
// outside, past a corner of the frustum. False for an empty box.
bool may_see(const Frustum& frustum, const WorldBox& box);

// From the eye to the closest place of the box, not empty; 0 inside.
double nearest_distance(const glm::dvec3& eye, const WorldBox& box);
// From the nearer of the eyes.
double nearest_distance(const Frustum& frustum, const WorldBox& box);
// To the corner farthest away.
double farthest_distance(const glm::dvec3& eye, const WorldBox& box);
// The smallest depth, along the unit vector `forward`, of any place of the box; negative behind the eye.
double nearest_depth(const glm::dvec3& eye, const glm::dvec3& forward, const WorldBox& box);

}  // namespace stipple
