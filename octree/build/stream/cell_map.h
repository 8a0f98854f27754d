// Which part of a cloud each point belongs to: cells counted as finely as they are full, merged into parts. Source of
// the idea: Schuetz, Ohrhallinger, Wimmer, "Fast Out-of-Core Octree Generation for Massive Point Clouds", 2020, section
// 3.1; there one grid of fixed fineness, here finer grids inside the cells that need them.
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "octree/build/chunks.h"

namespace stipple {

using CodeConsumer = std::function<void(std::span<const std::uint64_t>)>;
// Gives its consumer, from several threads at once, the codes of all points.
using CodeFeed = std::function<void(const CodeConsumer&)>;

class CellMap {
 public:
  // Of the octree cell of `level` with lowest code `code`.
  CellMap(int level, std::uint64_t code);

  // Counts all points, which lie in the cell, in the grids that have not been counted yet.
  void count(const CodeFeed& feed);
  // Puts finer grids into cells that hold more than `capacity` points; false when there are none and all is counted.
  bool refine(std::uint64_t capacity);

  // The largest octree cells that hold no more than `capacity` points, or are of the finest level, in Morton order;
  // `first` counts points. A cell of the finest level that holds more is raised to the topmost cell that it has to
  // itself. part_of() refers to the latest division.
  const std::vector<Chunk>& divide(std::uint64_t capacity);
  const std::vector<Chunk>& parts() const { return parts_; }

  std::uint32_t part_of(std::uint64_t code) const {
    const Grid* grid = &grids_.front();
    for (;;) {
      const std::size_t cell = grid->cell_of(code);
      if (grid->finer[cell] == kNoGrid) return grid->part[cell];
      grid = &grids_[grid->finer[cell]];
    }
  }

 private:
  static constexpr std::uint32_t kNoGrid = 0xFFFFFFFFu;

  struct Grid {
    Grid(int cell_level, int levels, std::uint64_t cell_code);
    std::size_t cell_of(std::uint64_t point_code) const { return (point_code >> shift) & (counts.size() - 1); }

    int level;       // of the cell it divides
    int grid_level;  // of its own cells
    int shift;
    std::uint64_t code;
    std::vector<std::uint64_t> counts;  // in Morton order
    std::vector<std::uint32_t> finer;   // grid inside the cell, or kNoGrid
    std::vector<std::uint32_t> part;    // of cells without a finer grid; undefined for empty ones
  };

  class Divider;

  std::vector<Grid> grids_;
  std::size_t counted_ = 0;  // grids
  std::vector<Chunk> parts_;
};

}  // namespace stipple
