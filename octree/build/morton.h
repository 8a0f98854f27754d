// Morton codes of 63 bits and the cube they subdivide.
//
//   bit   62 61 60   59 58 57  ...   2  1  0
//          x  y  z    x  y  z  ...   x  y  z
//         level 1    level 2        level 21
//
// The digit of a level is the index in Node::children of the child on that level.
#pragma once

#include <algorithm>
#include <bit>
#include <cstdint>
#include <glm/glm.hpp>

#include "octree/cloud/grid.h"
#include "octree/tree/octree.h"

namespace stipple {

// Cells along each axis on the finest level.
inline constexpr std::uint32_t kFinestCells = 1u << kMaxLevel;

// Moves bit i of the lower 21 to bit 3i. Source: F. Giesen, "Decoding Morton Codes", 2009, widened to 64 bits.
constexpr std::uint64_t spread_bits(std::uint32_t value) {
  std::uint64_t x = value & (kFinestCells - 1);
  x = (x | x << 32) & 0x001f00000000ffffu;
  x = (x | x << 16) & 0x001f0000ff0000ffu;
  x = (x | x << 8) & 0x100f00f00f00f00fu;
  x = (x | x << 4) & 0x10c30c30c30c30c3u;
  x = (x | x << 2) & 0x1249249249249249u;
  return x;
}

// The inverse: gathers bits 0, 3, 6, ... and ignores the others. Same source.
constexpr std::uint32_t gather_bits(std::uint64_t code) {
  std::uint64_t x = code & 0x1249249249249249u;
  x = (x | x >> 2) & 0x10c30c30c30c30c3u;
  x = (x | x >> 4) & 0x100f00f00f00f00fu;
  x = (x | x >> 8) & 0x001f0000ff0000ffu;
  x = (x | x >> 16) & 0x001f00000000ffffu;
  x = (x | x >> 32) & 0x00000000001fffffu;
  return static_cast<std::uint32_t>(x);
}

// `cell` below kFinestCells on each axis.
inline std::uint64_t morton_encode(const glm::uvec3& cell) {
  return spread_bits(cell.x) << 2 | spread_bits(cell.y) << 1 | spread_bits(cell.z);
}

inline glm::uvec3 morton_decode(std::uint64_t code) {
  return {gather_bits(code >> 2), gather_bits(code >> 1), gather_bits(code)};
}

// Bits of a code below the digit of `level`: code >> bits_below(level) numbers the cells of that level in Morton order.
constexpr int bits_below(int level) {
  return 3 * (kMaxLevel - level);
}

// Which child of its cell on level - 1 holds the code; level in [1, kMaxLevel].
constexpr unsigned morton_digit(std::uint64_t code, int level) {
  return (code >> bits_below(level)) & 7;
}

// Lowest code of the cell of `level` that holds `code`.
constexpr std::uint64_t cell_code(std::uint64_t code, int level) {
  return code >> bits_below(level) << bits_below(level);
}

// The deepest level on which both codes lie in the same cell; kMaxLevel when they are equal.
constexpr int common_level(std::uint64_t a, std::uint64_t b) {
  return a == b ? kMaxLevel : kMaxLevel - 1 - (63 - std::countl_zero(a ^ b)) / 3;
}

// The smallest cube whose minimum corner is that of `bounds` and that holds every grid step of `bounds` as a half-open
// box: its edge is above zero even for a single point. The default cube for empty bounds.
RootCube root_cube(const Grid& grid, const GridBox& bounds);

// Maps positions within `bounds` (not empty) to the finest cells of root_cube(grid, bounds). Defined by one double
// product per axis, hence the same on every machine; exact differences at any int32 coordinates.
class Quantizer {
 public:
  Quantizer(const Grid& grid, const GridBox& bounds);

  // Always below kFinestCells. Positions outside the bounds get a cell of the border, not always the nearest.
  glm::uvec3 cell(const glm::ivec3& position) const {
    const glm::uvec3 steps = glm::uvec3(position) - origin_;  // modulo 2^32, so that no difference overflows
    return {along(steps.x, cells_per_step_.x), along(steps.y, cells_per_step_.y), along(steps.z, cells_per_step_.z)};
  }
  std::uint64_t code(const glm::ivec3& position) const { return morton_encode(cell(position)); }

 private:
  static std::uint32_t along(std::uint32_t steps, double cells_per_step) {
    const auto cell = static_cast<std::int64_t>(steps * cells_per_step);
    return static_cast<std::uint32_t>(std::min<std::int64_t>(cell, kFinestCells - 1));
  }

  glm::uvec3 origin_;
  glm::dvec3 cells_per_step_;
};

}  // namespace stipple
