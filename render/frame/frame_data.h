// A drawn frame in main memory: what every renderer, GPU or CPU, ends with, and what metrics compare.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

#include "render/frame/point_set.h"

namespace stipple {

// Row by row, row 0 at the top. A pixel without a point has id kNoPoint, rgba 0, depth infinity, position 0.
struct FrameData {
  glm::ivec2 size{0};
  std::vector<std::uint32_t> ids;
  std::vector<std::uint32_t> rgba;
  std::vector<float> depth;  // along the line of sight, world units
  std::vector<glm::ivec3> positions;

  std::size_t pixels() const { return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y); }
  std::size_t covered_pixels() const;
};

// All arrays sized and empty.
FrameData empty_frame(const glm::ivec2& size);

// One picture of several of the same height, from left to right.
FrameData side_by_side(std::vector<FrameData> frames);

}  // namespace stipple
