// The camera of the window and what moves it: gestures, keys, and the points they are about.
#pragma once

#include <glm/glm.hpp>
#include <optional>

#include "octree/cloud/grid.h"
#include "src/viewer/navigation.h"

namespace stipple {

// Points are world coordinates, places framebuffer pixels.
class Rig {
 public:
  // A new cloud: what it is like, and where to begin. `near` is its near plane; nothing gets closer than a few of it.
  void enter(const WorldBox& box, const Camera& start, double near);
  // Exactly this camera.
  void place(const Camera& camera);
  // Looks at the whole cloud from this side; radians as in Pose.
  void face(double yaw, double pitch, double aspect);

  void orbit(const glm::dvec2& from, const glm::dvec2& to, const glm::ivec2& size);
  void turn(const glm::dvec2& from, const glm::dvec2& to, const glm::ivec2& size);
  // `grabbed`: the point that is to stay under the cursor; none: one as far away as the pivot.
  void pan(const glm::dvec2& from, const glm::dvec2& to, const glm::ivec2& size,
           const std::optional<glm::dvec3>& grabbed);
  // Towards `point` by so many notches of the wheel; none: to what is under the cursor as far away as the pivot.
  void zoom(double notches, const glm::dvec2& place, const glm::ivec2& size, const std::optional<glm::dvec3>& point);
  // `direction`: right, up and forward, each -1 to 1. As far in a second as the cloud is ahead.
  void fly(const glm::dvec3& direction, double seconds);

  // What turning is around.
  void set_pivot(const glm::dvec3& pivot) { pivot_ = pivot; }
  const glm::dvec3& pivot() const { return pivot_; }
  // What is straight ahead: says how fast to fly.
  void set_ahead(const glm::dvec3& point);

  const Camera& camera() const { return camera_; }
  // Whether anything but enter() and place() has set it.
  bool moved() const { return moved_; }
  View view(const glm::ivec2& size) const { return make_view(camera_, size, near_); }

 private:
  void set(const Pose& pose);
  double pivot_depth() const;

  Pose pose_;
  Camera camera_;
  WorldBox box_;
  glm::dvec3 pivot_{0.0};
  double radius_ = 1.0;  // of the cloud
  double reach_ = 1.0;   // to what is ahead
  double near_ = 1e-3;
  bool moved_ = false;
};

}  // namespace stipple
