// A view in the terms of octree/select.
#pragma once

#include "octree/select/frustum.h"
#include "render/frame/camera.h"

namespace stipple {

Frustum frustum_of(const View& view);

// World size of a pixel at the nearest place of the box, at least that at the near plane.
double nearest_pixel_size(const View& view, const WorldBox& box);

}  // namespace stipple
