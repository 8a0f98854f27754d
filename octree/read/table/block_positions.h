// The positions of one block of rows.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"
#include "octree/core/buffer.h"

namespace stipple {

// Coordinates beyond this are no place, as NaN and infinity are none: their squares and differences have to be numbers.
inline constexpr double kLargestCoordinate = 1e100;

// Keeps its memory from block to block.
class BlockPositions {
 public:
  // Takes x, y and z of `rows` rows as doubles; without a column, the coordinate is 0. Rows that are no place are left
  // out.
  void load(const std::array<const Column*, 3>& columns, std::size_t rows);

  std::size_t size() const { return size_; }
  // Whether no row was left out; else kept() has the numbers of the rows that are there.
  bool complete() const { return kept_.empty() && size_ == rows_; }
  std::span<const std::uint32_t> kept() const { return kept_; }
  std::span<const double> axis(int a) const { return std::span(axes_[static_cast<std::size_t>(a)]).first(size_); }

  // The nearest places on the grid, which must hold them all; `out` has size() elements.
  void put_on_grid(const Grid& grid, std::span<glm::ivec3> out) const;

  // Leaves only the kept rows in a column.
  void compact(Column& column) const;

 private:
  std::array<Buffer<double>, 3> axes_;
  Buffer<std::uint32_t> kept_;
  std::size_t rows_ = 0;
  std::size_t size_ = 0;
};

}  // namespace stipple
