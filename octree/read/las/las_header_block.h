// The header of the LAS files that we write.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "octree/cloud/grid.h"
#include "octree/read/las/las_format.h"

namespace stipple::las {

inline constexpr std::size_t kMaxReturns = 15;
inline constexpr std::size_t kWrittenHeaderSize = kHeaderSizes[4];

struct HeaderContent {
  int point_format = 0;  // 0 to 3
  std::uint64_t point_count = 0;
  std::array<std::uint64_t, kMaxReturns> counts_by_return{};  // [0] for return number 1
  Grid grid;
  WorldBox bounds;  // true ones; may be empty when there are no points
};

// The public header block of a LAS 1.4 file whose points follow at once, with no variable length records. The 32-bit
// counts are given when they can hold the number of points, else they are zero (LAS 1.4 R15, "Legacy Number of Point
// Records"). Creation date and project id are zero, so that equal points make equal files.
std::array<std::byte, kWrittenHeaderSize> header_block(const HeaderContent& content);

}  // namespace stipple::las
