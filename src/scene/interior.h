// The "interior" scene: terrestrial laser scans of a two-storey building.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "src/scene/model.h"

namespace stipple::scene {

// Where the scanner stood, in metres from the grid's offset. Scan k of n holds the points
// [points * k / n, points * (k + 1) / n), column by column.
const std::vector<glm::dvec3>& interior_scanners();

// Every ray has equal angular distance to its neighbours and hits something, so that density falls with the square of
// the distance and what stands in front leaves a shadow. Ranges are off by a few millimetres, a few points are
// outliers.
std::unique_ptr<SceneModel> make_interior(std::uint64_t points, std::uint64_t seed);

}  // namespace stipple::scene
