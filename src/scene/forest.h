// The "forest" scene: 400 m x 400 m of woodland.
#pragma once

#include <cstdint>
#include <memory>

#include "src/scene/model.h"

namespace stipple::scene {

// Porous layers over the ground: undergrowth, trunks, branches, crowns. Points come in cells of 20 m.
std::unique_ptr<SceneModel> make_forest(std::uint64_t points, std::uint64_t seed);

}  // namespace stipple::scene
