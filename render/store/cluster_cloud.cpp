#include "render/store/cluster_cloud.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <span>

#include "octree/build/morton.h"
#include "octree/core/error.h"

namespace stipple {
namespace {

constexpr std::uint64_t kClusterPoints = 256;  // docs/decisions/0011-hybrid.md

std::uint64_t points_of_a_cluster(std::uint64_t points) {
  return std::max(kClusterPoints, points / ClusterTable::kMostClusters + 1);
}

void append_chunk(ClusterTable& table, const PointSet& points, std::span<const std::uint32_t> order) {
  if (table.chunks.size() == ClusterTable::kMostChunks)
    throw Error(
        fmt::format("mode hybrid: {} points are more than it can draw; draw them in mode hierarchical", points.size()));
  ClusterTable::Chunk& chunk = table.chunks.emplace_back(ClusterTable::Chunk{
      GpuBuffer(order.size() * sizeof(PackedPoint)), GpuBuffer(order.size() * sizeof(std::uint32_t))});
  Buffer<PackedPoint> ordered(order.size());
  Buffer<std::uint32_t> ids(order.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, order.size(), 16384), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) {
      ordered[i] = points.points[order[i]];
      ids[i] = points.id(order[i]);
    }
  });
  chunk.points.write(0, std::span<const PackedPoint>(ordered));
  chunk.ids.write(0, std::span<const std::uint32_t>(ids));
}

}  // namespace

ClusterCut cut_cloud(const PointSet& points) {
  if (points.size() == 0) return {};
  return cut_clusters(points.grid, points.bounds, points.points, points_of_a_cluster(points.size()),
                      root_cube(points.grid, points.bounds).edge);
}

ClusterTable upload_clusters(const PointSet& points) {
  return upload_clusters(points, cut_cloud(points));
}

// Chunks end where a cluster ends.
ClusterTable upload_clusters(const PointSet& points, const ClusterCut& cut) {
  ClusterTable table;
  if (points.size() == 0) return table;
  table.root_edge = root_cube(points.grid, points.bounds).edge;
  const std::span<const std::uint32_t> order(cut.order);
  std::vector<ClusterTable::Row> rows;
  std::vector<float> log_pixels;
  std::vector<ShardBoxes> shards;
  std::uint32_t chunk_first = 0;
  for (std::size_t c = 0; c < cut.clusters.size(); ++c) {
    const ClusterCut::Piece& cluster = cut.clusters[c];
    if (cluster.first + cluster.count - chunk_first > ClusterTable::kChunkPoints) {
      append_chunk(table, points, order.subspan(chunk_first, cluster.first - chunk_first));
      chunk_first = cluster.first;
      const auto last = static_cast<std::uint32_t>(table.chunks.size() - 1) << ClusterTable::kPlaceBits;
      // Not at place 0, which begins a chunk
      while (rows.size() % ClusterTable::kBlock != 0) {
        rows.push_back({{}, last | 1u, {}, 0});
        log_pixels.insert(log_pixels.end(), ClusterTable::kLevels, 0.0f);
        shards.emplace_back();
      }
    }
    const auto chunk = static_cast<std::uint32_t>(table.chunks.size());
    rows.push_back({cluster.box.min, chunk << ClusterTable::kPlaceBits | (cluster.first - chunk_first), cluster.box.max,
                    cluster.count});
    const auto levels = cut.log_pixels.begin() + static_cast<std::ptrdiff_t>(c * ClusterTable::kLevels);
    log_pixels.insert(log_pixels.end(), levels, levels + ClusterTable::kLevels);
    shards.push_back(cut.shards[c]);
  }
  if (points.size() > chunk_first) append_chunk(table, points, order.subspan(chunk_first));
  table.allocate(static_cast<std::uint32_t>(rows.size()));
  table.write_rows(0, rows);
  table.write_log_pixels(0, log_pixels);
  table.write_shards(0, shards);
  table.size = table.capacity;
  return table;
}

std::uint64_t clusters_for(std::uint64_t points) {
  return points / points_of_a_cluster(points) + 1;
}

std::uint64_t cluster_bytes_for(std::uint64_t points) {
  return points * (sizeof(PackedPoint) + sizeof(std::uint32_t)) + clusters_for(points) * ClusterTable::kRowBytes;
}

}  // namespace stipple
