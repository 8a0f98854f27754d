#include "octree/build/builder.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <algorithm>

#include "octree/build/chunks.h"
#include "octree/build/join.h"
#include "octree/build/subtree.h"
#include "octree/core/error.h"

namespace stipple {
namespace {

void check(const PositionView& positions, const BuildOptions& options) {
  if (positions.size() >= Node::kNone)
    throw Error(fmt::format("an octree in memory holds fewer than {} points, not {}: build it in parts", Node::kNone,
                            positions.size()));
  if (options.leaf_capacity == 0 || options.cluster_points == 0)
    throw Error("leaf capacity and cluster size of an octree must be 1 point or more");
}

Buffer<CodedPoint> code_all(const Grid& grid, const GridBox& bounds, const PositionView& positions,
                            std::uint64_t seed) {
  Buffer<CodedPoint> points(positions.size());
  const Quantizer quantizer(grid, bounds);
  const Ranking ranking(seed);
  constexpr std::size_t kGrain = 1u << 14;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, points.size(), kGrain), [&](const auto& range) {
    code_points(positions, range.begin(), bounds, quantizer, ranking,
                std::span(points).subspan(range.begin(), range.size()));
  });
  return points;
}

}  // namespace

Octree build_octree(const Grid& grid, const GridBox& bounds, const PositionView& positions,
                    const BuildOptions& options) {
  check(positions, options);
  Buffer<CodedPoint> points = code_all(grid, bounds, positions, options.seed);
  const std::size_t capacity = std::max(options.chunk_points, options.leaf_capacity);
  const std::vector<Chunk> chunks = divide_into_chunks(points, capacity);
  std::vector<ChunkTree> trees(chunks.size());
  tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    const auto own = std::span(points).subspan(chunks[c].first, chunks[c].count);
    trees[c] = build_chunk_tree(chunks[c], own, positions, options);
  });
  points = {};
  Octree octree = join_chunk_trees(std::move(trees), positions, options);
  octree.grid = grid;
  octree.bounds = bounds;
  octree.cube = root_cube(grid, bounds);
  return octree;
}

}  // namespace stipple
