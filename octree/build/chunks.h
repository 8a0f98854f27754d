// Dividing points into chunks that one thread can build a subtree of, inside its cache or, streaming, inside its
// memory: count on a coarse grid, merge cells into chunks, distribute. Source of the idea: Schuetz, Ohrhallinger,
// Wimmer, "Fast Out-of-Core Octree Generation for Massive Point Clouds", 2020, section 3.1.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "octree/build/coded_point.h"

namespace stipple {

// All points of one octree cell.
struct Chunk {
  int level = 0;
  std::uint64_t code = 0;  // lowest of the cell
  std::size_t first = 0;   // among the points, chunk after chunk
  std::size_t count = 0;
};

// Points in each cell of a grid inside one octree cell, in Morton order.
class CellCounts {
 public:
  // The grid is kGridLevels finer than `level`, or as fine as codes are.
  explicit CellCounts(int level);

  void add(std::span<const CodedPoint> batch);
  void add(const CellCounts& other);  // of the same cell

  int level() const { return level_; }
  int grid_level() const { return grid_level_; }
  std::size_t size() const { return counts_.size(); }
  std::size_t operator[](std::size_t cell) const { return counts_[cell]; }
  // Which cell of the grid holds the code.
  std::size_t cell_of(std::uint64_t code) const { return (code >> bits_below(grid_level_)) % counts_.size(); }

 private:
  static constexpr int kGridLevels = 6;  // 262,144 cells: 1 MiB, stays in the L2 cache

  int level_;
  int grid_level_;
  std::vector<std::uint32_t> counts_;
};

// Chunks in Morton order, and where each cell of the grid belongs.
struct ChunkMap {
  std::vector<Chunk> chunks;
  std::vector<std::uint32_t> chunk_of_cell;  // index in chunks; undefined for empty cells
};

// The largest octree cells that hold no more than `capacity` points, or are single cells of the grid; none is empty.
// `code` is the lowest of the cell that was counted.
ChunkMap merge_cells(const CellCounts& counts, std::uint64_t code, std::size_t capacity);

// All of it in memory, on all cores. On return `points` stand chunk after chunk, in no particular order inside one.
// Takes 16 bytes a point while working. A chunk that still exceeds the capacity has a single code, and is then the
// topmost cell without other codes.
std::vector<Chunk> divide_into_chunks(std::span<CodedPoint> points, std::size_t capacity);

}  // namespace stipple
