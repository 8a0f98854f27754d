// How close points stand.
#pragma once

#include <glm/glm.hpp>
#include <span>

namespace stipple {

// The smallest distance between any two of the points, in world units; infinity for fewer than two. Expected time
// linear in the number of points, wherever they are. Source: Golin, Raman, Schwarz, Smid, "Simple Randomized Algorithms
// for Closest Pair Problems", 1995.
double closest_pair(std::span<const glm::ivec3> positions, const glm::dvec3& scale);

}  // namespace stipple
