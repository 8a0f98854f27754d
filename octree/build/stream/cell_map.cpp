#include "octree/build/stream/cell_map.h"

#include <tbb/enumerable_thread_specific.h>

#include <algorithm>

namespace stipple {
namespace {

constexpr int kCoarseLevels = 6;  // 262,144 cells: counts of one thread are 1 MiB and stay in the L2 cache
constexpr int kFineLevels = 3;    // 512 cells, where many cells are divided at once
constexpr std::size_t kManyGrids = 4;

}  // namespace

CellMap::Grid::Grid(int cell_level, int levels, std::uint64_t cell_code)
    : level(cell_level),
      grid_level(std::min(cell_level + levels, kMaxLevel)),
      shift(bits_below(grid_level)),
      code(cell_code),
      counts(std::size_t{1} << 3 * (grid_level - level)),
      finer(counts.size(), kNoGrid),
      part(counts.size()) {}

CellMap::CellMap(int level, std::uint64_t code) {
  grids_.emplace_back(level, kCoarseLevels, code);
}

void CellMap::count(const CodeFeed& feed) {
  struct Cell {
    std::size_t grid, cell;
  };
  struct Part {  // of one thread: half the bytes, so that the counts stay in the cache
    std::vector<std::vector<std::uint32_t>> counts;
    std::vector<Cell> wrapped;  // once for each 2^32 points
  };
  tbb::enumerable_thread_specific<Part> parts([this] {
    Part part;
    for (std::size_t g = counted_; g < grids_.size(); ++g) part.counts.emplace_back(grids_[g].counts.size());
    return part;
  });
  feed([&](std::span<const std::uint64_t> codes) {
    Part& part = parts.local();
    for (const std::uint64_t code : codes) {
      std::size_t g = 0;
      std::size_t cell = grids_[0].cell_of(code);
      while (grids_[g].finer[cell] != kNoGrid) {
        g = grids_[g].finer[cell];
        cell = grids_[g].cell_of(code);
      }
      if (g >= counted_ && ++part.counts[g - counted_][cell] == 0) part.wrapped.push_back({g, cell});
    }
  });
  for (const Part& part : parts) {
    for (std::size_t g = counted_; g < grids_.size(); ++g)
      for (std::size_t cell = 0; cell < grids_[g].counts.size(); ++cell)
        grids_[g].counts[cell] += part.counts[g - counted_][cell];
    for (const auto& [g, cell] : part.wrapped) grids_[g].counts[cell] += std::uint64_t{1} << 32;
  }
  counted_ = grids_.size();
}

bool CellMap::refine(std::uint64_t capacity) {
  struct Full {
    std::size_t grid, cell;
  };
  std::vector<Full> full;
  for (std::size_t g = 0; g < grids_.size(); ++g)
    for (std::size_t cell = 0; cell < grids_[g].counts.size(); ++cell)
      if (grids_[g].counts[cell] > capacity && grids_[g].finer[cell] == kNoGrid && grids_[g].grid_level < kMaxLevel)
        full.push_back({g, cell});
  const int levels = full.size() > kManyGrids ? kFineLevels : kCoarseLevels;
  for (const auto& [g, cell] : full) {
    grids_[g].finer[cell] = static_cast<std::uint32_t>(grids_.size());
    grids_.emplace_back(grids_[g].grid_level, levels, grids_[g].code + (std::uint64_t{cell} << grids_[g].shift));
  }
  return !full.empty();
}

// Walks down from the whole cell, as far as cells hold too many points.
class CellMap::Divider {
 public:
  Divider(CellMap& map, std::uint64_t capacity) : map_(map), capacity_(capacity) {}

  void visit_grid(std::size_t g) {
    std::vector<std::uint64_t> sums{0};
    for (const std::uint64_t count : map_.grids_[g].counts) sums.push_back(sums.back() + count);
    visit(g, sums, map_.grids_[g].level, 0);
  }

 private:
  void visit(std::size_t g, const std::vector<std::uint64_t>& sums, int level, std::size_t first) {
    Grid& grid = map_.grids_[g];
    const std::size_t cells = std::size_t{1} << 3 * (grid.grid_level - level);
    const std::uint64_t points = sums[first + cells] - sums[first];
    if (points == 0) return;
    if (points > capacity_ && level < grid.grid_level) {
      for (std::size_t digit = 0; digit < 8; ++digit) visit(g, sums, level + 1, first + digit * (cells / 8));
      return;
    }
    if (points > capacity_ && grid.finer[first] != kNoGrid) return visit_grid(grid.finer[first]);
    set_part(g, first, cells, static_cast<std::uint32_t>(map_.parts_.size()));
    const std::uint64_t code = grid.code + (std::uint64_t{first} << grid.shift);
    map_.parts_.push_back({level, code, first_point_, points});
    first_point_ += points;
  }

  void set_part(std::size_t g, std::size_t first, std::size_t cells, std::uint32_t part) {
    for (std::size_t cell = first; cell < first + cells; ++cell) {
      map_.grids_[g].part[cell] = part;
      const std::uint32_t finer = map_.grids_[g].finer[cell];
      if (finer != kNoGrid) set_part(finer, 0, map_.grids_[finer].counts.size(), part);
    }
  }

  CellMap& map_;
  std::uint64_t capacity_;
  std::uint64_t first_point_ = 0;
};

const std::vector<Chunk>& CellMap::divide(std::uint64_t capacity) {
  parts_.clear();
  Divider(*this, capacity).visit_grid(0);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    Chunk& part = parts_[p];
    if (part.count <= capacity || part.level < kMaxLevel) continue;
    const std::uint64_t code = part.code;
    part.level = grids_.front().level;
    if (p > 0) part.level = std::max(part.level, common_level(code, parts_[p - 1].code) + 1);
    if (p + 1 < parts_.size()) part.level = std::max(part.level, common_level(code, parts_[p + 1].code) + 1);
    part.code = cell_code(code, part.level);
  }
  return parts_;
}

}  // namespace stipple
