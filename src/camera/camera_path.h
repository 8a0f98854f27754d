// A camera that moves.
#pragma once

#include <string>
#include <vector>

#include "render/frame/camera.h"
#include "render/frame/propose_views.h"

namespace stipple {

struct TimedCamera {
  double seconds = 0.0;
  Camera camera;
};

// Cameras by ascending time, at least one.
struct CameraPath {
  std::string name;
  std::vector<TimedCamera> keys;

  double start() const { return keys.front().seconds; }
  double duration() const { return keys.back().seconds - start(); }
};

// Passes through every key at its time, without a jerk between them: eye and target follow cubic Hermite curves whose
// tangents are those of the parabola through a key and its neighbours; up and field of view change linearly. Before the
// first key it is the first, after the last the last. Two keys make a straight line at constant speed.
Camera camera_at(const CameraPath& path, double seconds);

// Cameras at `count` moments, evenly spaced from the first key to the last; 1 or more.
std::vector<Camera> cameras_along(const CameraPath& path, int count);

// For a cloud that nobody has flown through yet, from cameras that propose_cameras() gave for it: in 2.4 seconds from
// the first ("oblique"), seen whole, down towards the last ("low") and halfway there.
CameraPath propose_path(const std::vector<NamedCamera>& proposed);

}  // namespace stipple
