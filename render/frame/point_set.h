// Points as the renderers take them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>

#include "octree/cloud/grid.h"
#include "octree/core/buffer.h"

namespace stipple {

// The id that stands for "no point".
inline constexpr std::uint32_t kNoPoint = 0xFFFFFFFFu;

// 16 bytes, on the GPU as here. rgba: red in the lowest byte, alpha in the highest: 255, or 0 for a point that is not
// drawn.
struct PackedPoint {
  glm::ivec3 position;
  std::uint32_t rgba;
};
static_assert(sizeof(PackedPoint) == 16);

struct PointSet {
  Grid grid;
  GridBox bounds;
  Buffer<PackedPoint> points;
  Buffer<std::uint32_t> ids;  // stable id of each point; empty when point i has id i

  std::size_t size() const { return points.size(); }
  std::uint32_t id(std::size_t i) const { return ids.empty() ? static_cast<std::uint32_t>(i) : ids[i]; }
};

}  // namespace stipple
