// How long a running build of a tree still takes.
#pragma once

#include "octree/build/stream/monitor.h"

namespace stipple {

// Share of the work that is done, 0 to 1.
double share_done(const BuildProgress& progress);

struct BuildEstimate {
  double rate = 0.0;  // points of the input a second, over all phases
  double seconds_left = 0.0;
};

// After so many seconds of it; zeros where nothing can be said yet.
BuildEstimate estimate(const BuildProgress& progress, double seconds);

}  // namespace stipple
