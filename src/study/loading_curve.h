// One method drawing a view while the points are read.
#pragma once

#include <string>
#include <vector>

#include "src/study/curve.h"
#include "src/study/frame_keeper.h"
#include "src/study/progress.h"
#include "src/study/study.h"
#include "src/study/truth.h"

namespace stipple {

// By the wall clock `input`, of which `dataset` is what was read before, is read once more, and time counts from there;
// metrics are measured while reading stands still. By the clock that counts points, the points come from memory in the
// order of their ids, in each frame as many as it may draw. The truth is that of the whole cloud. Frames go to
// `keeper`, where there is one. Throws Error for an octree on disk.
std::vector<CurvePoint> draw_while_loading(const StudySettings& settings, const std::string& input,
                                           const Dataset& dataset, Mode mode, const StudyProgress& progress,
                                           const View& view, const Truth& truth, FrameKeeper* keeper);

}  // namespace stipple
