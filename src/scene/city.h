// The "city" scene: a square kilometre of streets and several hundred buildings with storeys inside.
#pragma once

#include <cstdint>
#include <memory>

#include "src/scene/model.h"

namespace stipple::scene {

// The extent does not depend on `points`: more of them are denser. Points are uniform over the area of all surfaces,
// and come block by block.
std::unique_ptr<SceneModel> make_city(std::uint64_t points, std::uint64_t seed);

}  // namespace stipple::scene
