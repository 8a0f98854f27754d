// The cube that the root of a tree has.
#pragma once

#include "octree/cloud/grid.h"
#include "octree/store/json_value.h"

namespace stipple {

// Throws Error naming `json`, from which the box was read, when it is no cube: a maximum is below its minimum, or the
// edges differ by more than a writer's rounding, floats included.
void check_cube(const WorldBox& box, const JsonValue& json);

}  // namespace stipple
