#include "render/frame/view_frustum.h"

#include <algorithm>
#include <cmath>

namespace stipple {

Frustum frustum_of(const View& view) {
  Frustum frustum = make_frustum(view.eye, view.right, view.up, view.forward, std::atan(1.0 / view.cot_x),
                                 std::atan(1.0 / view.cot_y));
  frustum.to_side = view.right * (0.5 * view.eyes_apart);
  return frustum;
}

double nearest_pixel_size(const View& view, const WorldBox& box) {
  return view.pixel_size(std::max(nearest_depth(view.eye, view.forward, box), view.near));
}

}  // namespace stipple
