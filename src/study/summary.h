// What a curve comes down to.
#pragma once

#include <span>

#include "src/json/json.h"
#include "src/study/curve.h"

namespace stipple {

// Of the repeats of one mode, regime and view: work to each quality (medians, and the spread of the times), frame times
// and how many frames took longer than `target_ms` (0: no target), the quality of the last frame, means over all
// frames, and whether it ended identical to brute force; see docs/study.md. At least one repeat, each of at least one
// frame.
Json summary_json(std::span<const Curve> repeats, double target_ms = 0.0);

}  // namespace stipple
