// The "terrain" scene: open country of 4 km x 4 km, one surface.
#pragma once

#include <cstdint>
#include <memory>

#include "src/scene/model.h"

namespace stipple::scene {

// Points come flight strip by flight strip, in the zigzag of an oscillating mirror; strips overlap sideways.
std::unique_ptr<SceneModel> make_terrain(std::uint64_t points, std::uint64_t seed);

}  // namespace stipple::scene
