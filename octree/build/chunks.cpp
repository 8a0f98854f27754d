#include "octree/build/chunks.h"

#include <tbb/blocked_range.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>

#include "octree/core/buffer.h"

namespace stipple {
namespace {

constexpr std::size_t kBatchPoints = 1u << 16;  // a batch is counted and then moved: it should stay in the L2 cache

template <class Function>
void for_each_batch(std::span<CodedPoint> points, const Function& function) {
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, (points.size() + kBatchPoints - 1) / kBatchPoints),
                    [&](const tbb::blocked_range<std::size_t>& batches) {
                      for (std::size_t b = batches.begin(); b < batches.end(); ++b) {
                        const std::size_t first = b * kBatchPoints;
                        function(points.subspan(first, std::min(kBatchPoints, points.size() - first)));
                      }
                    });
}

CellCounts count_all(std::span<CodedPoint> points, int level) {
  tbb::enumerable_thread_specific<CellCounts> counts([level] { return CellCounts(level); });
  for_each_batch(points, [&](std::span<const CodedPoint> batch) { counts.local().add(batch); });
  CellCounts total(level);
  for (const CellCounts& part : counts) total.add(part);
  return total;
}

// Moves each point to its chunk's place in `to`. Threads reserve room batch by batch: the order inside a chunk is that
// of arrival.
void distribute(std::span<CodedPoint> from, const CellCounts& counts, const ChunkMap& map, std::span<CodedPoint> to) {
  std::vector<std::atomic<std::size_t>> next(map.chunks.size());
  for (std::size_t c = 0; c < next.size(); ++c) next[c] = map.chunks[c].first;
  const auto chunk_of = [&](const CodedPoint& point) { return map.chunk_of_cell[counts.cell_of(point.code)]; };
  for_each_batch(from, [&](std::span<const CodedPoint> batch) {
    std::vector<std::size_t> place(next.size());
    for (const CodedPoint& point : batch) ++place[chunk_of(point)];
    for (std::size_t c = 0; c < place.size(); ++c)
      if (place[c] > 0) place[c] = next[c].fetch_add(place[c], std::memory_order_relaxed);
    for (const CodedPoint& point : batch) to[place[chunk_of(point)]++] = point;
  });
}

bool share_a_code(std::span<const CodedPoint> points) {
  return std::all_of(points.begin(), points.end(),
                     [&](const CodedPoint& point) { return point.code == points.front().code; });
}

// Walks down from the cell that was counted, as far as cells hold too many points.
class CellMerger {
 public:
  CellMerger(const CellCounts& counts, std::size_t capacity) : counts_(counts), capacity_(capacity), sums_(1) {
    for (std::size_t c = 0; c < counts.size(); ++c) sums_.push_back(sums_.back() + counts[c]);
  }

  void visit(int level, std::uint64_t code) {
    const std::size_t cells = std::size_t{1} << 3 * (counts_.grid_level() - level);
    const std::size_t first_cell = counts_.cell_of(code);
    const std::size_t points = sums_[first_cell + cells] - sums_[first_cell];
    if (points == 0) return;
    if (points > capacity_ && level < counts_.grid_level()) {
      for (std::uint64_t digit = 0; digit < 8; ++digit) visit(level + 1, code + (digit << bits_below(level + 1)));
      return;
    }
    std::fill_n(map_.chunk_of_cell.begin() + first_cell, cells, map_.chunks.size());
    map_.chunks.push_back({level, code, sums_[first_cell], points});
  }

  ChunkMap run(std::uint64_t code) {
    map_.chunk_of_cell.resize(counts_.size());
    visit(counts_.level(), code);
    return std::move(map_);
  }

 private:
  const CellCounts& counts_;
  std::size_t capacity_;
  std::vector<std::size_t> sums_;  // points in cells before this one
  ChunkMap map_;
};

void split(const Chunk& chunk, std::span<CodedPoint> points, std::span<CodedPoint> scratch, std::size_t capacity,
           std::vector<Chunk>& chunks) {
  const auto here = points.subspan(chunk.first, chunk.count);
  if (chunk.count <= capacity || share_a_code(here)) {
    chunks.push_back(chunk);
    return;
  }
  const CellCounts counts = count_all(here, chunk.level);
  ChunkMap map = merge_cells(counts, chunk.code, capacity);
  const auto moved = scratch.subspan(chunk.first, chunk.count);
  distribute(here, counts, map, moved);
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, here.size(), kBatchPoints), [&](const auto& range) {
    std::copy(moved.begin() + range.begin(), moved.begin() + range.end(), here.begin() + range.begin());
  });
  for (Chunk& part : map.chunks) {
    part.first += chunk.first;
    split(part, points, scratch, capacity, chunks);
  }
}

// A chunk of a single code that is too large would be a leaf at any level: raise it to the topmost cell that it has to
// itself.
void raise_single_codes(std::vector<Chunk>& chunks, std::span<const CodedPoint> points, std::size_t capacity) {
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    Chunk& chunk = chunks[c];
    if (chunk.count <= capacity) continue;
    const std::uint64_t code = points[chunk.first].code;
    chunk.level = 0;
    if (c > 0) chunk.level = common_level(code, points[chunk.first - 1].code) + 1;
    if (c + 1 < chunks.size())
      chunk.level = std::max(chunk.level, common_level(code, points[chunk.first + chunk.count].code) + 1);
    chunk.code = cell_code(code, chunk.level);
  }
}

}  // namespace

CellCounts::CellCounts(int level)
    : level_(level),
      grid_level_(std::min(level + kGridLevels, kMaxLevel)),
      counts_(std::size_t{1} << 3 * (grid_level_ - level)) {}

void CellCounts::add(std::span<const CodedPoint> batch) {
  for (const CodedPoint& point : batch) ++counts_[cell_of(point.code)];
}

void CellCounts::add(const CellCounts& other) {
  for (std::size_t cell = 0; cell < size(); ++cell) counts_[cell] += other.counts_[cell];
}

ChunkMap merge_cells(const CellCounts& counts, std::uint64_t code, std::size_t capacity) {
  return CellMerger(counts, capacity).run(code);
}

std::vector<Chunk> divide_into_chunks(std::span<CodedPoint> points, std::size_t capacity) {
  std::vector<Chunk> chunks;
  Buffer<CodedPoint> scratch(points.size());
  if (!points.empty()) split({0, 0, 0, points.size()}, points, scratch, capacity, chunks);
  raise_single_codes(chunks, points, capacity);
  return chunks;
}

}  // namespace stipple
