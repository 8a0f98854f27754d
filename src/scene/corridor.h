// The "corridor" scene: a railway survey, 100 km from end to end and 60 m wide.
#pragma once

#include <cstdint>
#include <memory>

#include "src/scene/model.h"

namespace stipple::scene {

// Double track with catenary, a pair of masts every 60 m, embankment and vegetation, in UTM coordinates (easting 300 km
// to 400 km, northing about 5,300 km). Points come span by span, from west to east.
std::unique_ptr<SceneModel> make_corridor(std::uint64_t points, std::uint64_t seed);

}  // namespace stipple::scene
