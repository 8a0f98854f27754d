// How large points are drawn: round splats of a world size near the eye, squares of some pixels far from it. After
// viewers of binary trees that draw near and far nodes with two materials.
#pragma once

#include "octree/cloud/grid.h"
#include "render/frame/camera.h"

namespace stipple {

struct PointSize {
  // A splat's diameter on the screen goes no further, in pixels: less than any driver or shader loop limits.
  static constexpr double kLargestSplat = 250.0;

  double pixels = 1.0;  // edge of a far point's square
  double world = 0.0;   // diameter of a near point's splat, world units; 0: there are no splats

  PointSize() = default;
  // Implicit: a size in pixels is what most have to say.
  PointSize(double in_pixels, double in_world = 0.0) : pixels(in_pixels), world(in_world) {}

  bool operator==(const PointSize&) const = default;

  // Whether a point may cover more than the pixel it falls into, or less.
  bool varies() const { return pixels != 1.0 || world > 0.0; }
  // Whether a point may cover several pixels.
  bool spreads() const { return pixels > 1.0 || world > 0.0; }

  // Diameter in pixels of a splat at depth 1; at depth d it is this / d. The point is near, and its splat drawn, where
  // that is more than `pixels`.
  double splat_at_one(const View& view) const { return 0.5 * world * view.cot_y * view.size.y; }
};

// Of the points of a box, by its nearest and farthest place.
enum class SplatRange {
  far,     // none of them is a splat, certainly
  near,    // all are
  across,  // there may be both
};

// Allows for shaders that compute a depth in single precision.
SplatRange splat_range(const PointSize& point_size, const View& view, const WorldBox& box);

}  // namespace stipple
