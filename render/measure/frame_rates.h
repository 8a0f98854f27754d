// What is wrong with a frame, pixel by pixel: told from points, not from colours.
#pragma once

#include <cstdint>

#include "octree/cloud/grid.h"
#include "render/frame/camera.h"
#include "render/frame/frame_data.h"
#include "render/frame/point_size.h"

namespace stipple {

struct RateTolerances {
  // Relative difference of depth up to which two points belong to one surface. A pixel of the default camera (60
  // degrees, 720 rows) spans 0.0016 of its depth: one percent is a surface seen at 9 degrees.
  double depth = 0.01;
  // Pixels, beyond half a point's size, that a point may be drawn off its place: the rounding of rasterizers.
  double place = 1.0;
};

// Shares of the pixels that the test or the reference covers. A pixel counts for at most one of the four; the rest of
// the covered pixels show the reference's point in its place. For a pixel with centre c, let R and T say whether
// reference and test cover it, r and t be their points, z(r) and z(t) the depths in the frames, and for the position of
// t let x be its place in pixels by the view, and d its depth by the view. In this order:
//
//   hole         R, not T
//   ghost        T, and not R:                     nothing is there
//                or max |x - c| > s / 2 + place, s the point's size on the screen at d, or |z(t) - d| > depth * d, or t
//                lies before the near plane:
//                                                  stale, t is not seen here from this view
//                or z(t) < (1 - depth) * z(r):     in front of the nearest point there is
//   see_through  z(t) > (1 + depth) * z(r):        what lies behind, through a surface not yet closed
//   wrong_point  id of t is not that of r:         another point of the same surface
struct FrameRates {
  std::uint64_t covered_pixels = 0;  // by either
  double hole = 0.0;
  double ghost = 0.0;
  double see_through = 0.0;
  double wrong_point = 0.0;
  // |z(t) - z(r)| / z(r) over the pixels that both cover: mean and 95th percentile (nearest rank). 0 where there are
  // none.
  double depth_error_mean = 0.0;
  double depth_error_p95 = 0.0;
};

// Both frames show the same cloud, whose grid is given, from `view`; the reference is render_reference's, with this
// `point_size`. Not symmetric. All cores; the result does not depend on their number. Throws Error when the sizes
// differ.
FrameRates frame_rates(const FrameData& test, const FrameData& reference, const View& view, const Grid& grid,
                       const PointSize& point_size = {}, const RateTolerances& tolerances = {});

}  // namespace stipple
