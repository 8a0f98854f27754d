// Cameras for a cloud that nobody has looked at yet.
#pragma once

#include <string>
#include <vector>

#include "octree/cloud/grid.h"
#include "render/frame/camera.h"
#include "render/frame/point_set.h"

namespace stipple {

struct NamedCamera {
  std::string name;
  Camera camera;
};

// "oblique" and "aerial" show everything from 30 and 75 degrees above the horizon, "low" looks along the cloud from
// just above what stands around the eye. `aspect` is width over height. Stray points far outside do not count. Depends
// on ids, not on the order of the points. An empty cloud gives cameras near the origin.
std::vector<NamedCamera> propose_cameras(const PointSet& points, double aspect);

// Holds all but the outermost half percent of the points along each axis: the box those cameras are laid around. An
// empty cloud gives the origin.
WorldBox robust_bounds(const PointSet& points);

}  // namespace stipple
