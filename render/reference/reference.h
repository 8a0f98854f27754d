// The one ground truth: every point, double precision, on the CPU.
#pragma once

#include "render/frame/camera.h"
#include "render/frame/frame_data.h"
#include "render/frame/point_set.h"

namespace stipple {

// The nearest point (smallest depth in double precision) wins a pixel, ties go to the lowest id. Points are clipped by
// their centre and cover the pixels whose centre lies in their square of `point_size` pixels (1: the pixel they fall
// into). All cores; the result does not depend on their number. Needs 16 bytes a pixel beside the frame. Throws
// UsageError when `point_size` is not above 0.
FrameData render_reference(const PointSet& points, const View& view, double point_size = 1.0);

}  // namespace stipple
