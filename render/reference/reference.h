// The one ground truth: every point, double precision, on the CPU.
#pragma once

#include "render/frame/camera.h"
#include "render/frame/frame_data.h"
#include "render/frame/point_set.h"
#include "render/frame/point_size.h"

namespace stipple {

// The nearest point (smallest depth in double precision) wins a pixel, ties go to the lowest id. Points are clipped by
// their centre. They cover the pixels whose centre lies in their square of point_size.pixels (1: the pixel they fall
// into), or, near enough, in their splat's disc, beside the pixel they fall into. All cores; the result does not depend
// on their number. Needs 16 bytes a pixel beside the frame. Throws UsageError for sizes that are none.
FrameData render_reference(const PointSet& points, const View& view, const PointSize& point_size = {});

}  // namespace stipple
