// What a view finds of what a method draws from.
#pragma once

#include "octree/cloud/grid.h"

namespace stipple {

// A node, or a cluster of one, that the current view may see.
struct SightedBox {
  enum class State {
    waiting,   // in sight, and none of its points drawn in this view
    streamed,  // some of them
    complete,  // all that it may see
    occluded,  // what it had left is hidden behind what is drawn
  };
  GridBox box;
  State state = State::waiting;
};

}  // namespace stipple
