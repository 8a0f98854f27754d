#include "render/frame/point_size.h"

#include "octree/select/frustum.h"

namespace stipple {
namespace {

// Of the distance to the farthest place of a box: world coordinates and depths rounded to 6e-8 a few times.
constexpr double kDepthSlack = 1e-5;

}  // namespace

SplatRange splat_range(const PointSize& point_size, const View& view, const WorldBox& box) {
  if (point_size.world == 0.0) return SplatRange::far;
  // Where a splat is as wide as a far point
  const double threshold = point_size.splat_at_one(view) / point_size.pixels;
  const double slack = kDepthSlack * (farthest_distance(view.eye, box) + 0.5 * view.eyes_apart);
  if (nearest_depth(view.eye, view.forward, box) - slack > threshold) return SplatRange::far;
  return -nearest_depth(view.eye, -view.forward, box) + slack < threshold ? SplatRange::near : SplatRange::across;
}

}  // namespace stipple
