// What every comparison of two pictures asks first.
#pragma once

#include <fmt/format.h>

#include <glm/glm.hpp>

#include "octree/core/error.h"

namespace stipple {

// Throws Error when the sizes differ.
inline void require_same_size(const glm::ivec2& a, const glm::ivec2& b) {
  if (a != b)
    throw Error(fmt::format("cannot compare a picture of {}x{} pixels with one of {}x{}", a.x, a.y, b.x, b.y));
}

}  // namespace stipple
