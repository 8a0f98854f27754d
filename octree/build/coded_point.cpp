#include "octree/build/coded_point.h"

#include <fmt/format.h>

#include "octree/build/hash.h"
#include "octree/core/error.h"

namespace stipple {

Ranking::Ranking(std::uint64_t seed)
    : flip_(static_cast<std::uint32_t>(mix64(seed + 1))), shift_(static_cast<std::uint32_t>(mix64(seed + 1) >> 32)) {}

std::uint32_t Ranking::operator()(std::uint32_t id) const {
  return mix32(mix32(id ^ flip_) + shift_);
}

void code_points(const PositionView& positions, std::size_t first, const GridBox& bounds, const Quantizer& quantizer,
                 const Ranking& ranking, std::span<CodedPoint> coded) {
  for (std::size_t i = 0; i < coded.size(); ++i) {
    const glm::ivec3& p = positions[first + i];
    if (!bounds.contains(p))
      throw Error(
          fmt::format("point {} at grid position ({}, {}, {}) is outside the bounds ({}, {}, {}) to ({}, {}, {})"
                      " that were given for the octree: compute them from the points, headers may be wrong",
                      first + i, p.x, p.y, p.z, bounds.min.x, bounds.min.y, bounds.min.z, bounds.max.x, bounds.max.y,
                      bounds.max.z));
    const auto id = static_cast<std::uint32_t>(first + i);
    coded[i] = {quantizer.code(p), id, ranking(id)};
  }
}

}  // namespace stipple
