#include "render/store/cluster_cloud.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "octree/build/builder.h"
#include "octree/core/error.h"
#include "octree/select/density.h"

namespace stipple {
namespace {

static_assert(sizeof(ClusterCloud::ClusterBox) == 32);

// Points of a cluster: docs/decisions/0011-hybrid.md. More where the table of clusters would outgrow what shaders reach
// on Mesa's software renderer, 128 MiB.
constexpr std::uint64_t kClusterPoints = 128;
constexpr std::uint64_t kMostClusters = 1'000'000;

std::uint64_t points_of_a_cluster(std::uint64_t points) {
  return std::max(kClusterPoints, points / kMostClusters + 1);
}

// An octree of a single leaf: its clusters follow the Morton curve.
Octree flat_octree(const PointSet& points) {
  BuildOptions options;
  options.leaf_capacity = std::numeric_limits<std::size_t>::max();
  options.cluster_points = points_of_a_cluster(points.size());
  return build_octree(points.grid, points.bounds,
                      PositionView(std::span<const PackedPoint>(points.points), &PackedPoint::position), options);
}

}  // namespace

ClusterCloud::ClusterCloud(const PointSet& points) {
  const Octree octree = flat_octree(points);
  root_edge_ = octree.cube.edge;
  clusters_ = static_cast<std::uint32_t>(octree.clusters.size());
  const std::span<const std::uint32_t> order(octree.order);
  std::vector<ClusterBox> boxes;
  boxes.reserve(octree.clusters.size());
  std::uint32_t chunk_first = 0;
  for (const Cluster& cluster : octree.clusters) {
    if (cluster.first + cluster.count - chunk_first > kChunkPoints) {
      append_chunk(points, order.subspan(chunk_first, cluster.first - chunk_first));
      chunk_first = cluster.first;
    }
    const auto chunk = static_cast<std::uint32_t>(chunks_.size());
    boxes.push_back(
        {cluster.box.min, chunk << kPlaceBits | (cluster.first - chunk_first), cluster.box.max, cluster.count});
  }
  if (points.size() > chunk_first) append_chunk(points, order.subspan(chunk_first));
  write_tables(octree, boxes);
}

void ClusterCloud::append_chunk(const PointSet& points, std::span<const std::uint32_t> order) {
  if (chunks_.size() == kMostChunks)
    throw Error(
        fmt::format("mode hybrid: {} points are more than it can draw; draw them in mode hierarchical", points.size()));
  Chunk& chunk = chunks_.emplace_back(
      Chunk{GpuBuffer(order.size() * sizeof(PackedPoint)), GpuBuffer(order.size() * sizeof(std::uint32_t))});
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

void ClusterCloud::write_tables(const Octree& octree, std::span<const ClusterBox> boxes) {
  std::vector<float> log_pixels(boxes.size() * kLevels);
  tbb::parallel_for(std::size_t{0}, boxes.size(), [&](std::size_t i) {
    for (int level = 0; level < kLevels; ++level) {
      const double pixels = estimated_pixels(octree.clusters[i].profile, root_edge_, root_edge_ * std::exp2(-level));
      log_pixels[i * kLevels + static_cast<std::size_t>(level)] = static_cast<float>(std::log2(std::max(pixels, 1.0)));
    }
  });
  boxes_ = GpuBuffer(boxes.size_bytes());
  boxes_.write(0, boxes);
  log_pixels_ = GpuBuffer(log_pixels.size() * sizeof(float));
  log_pixels_.write(0, std::span<const float>(log_pixels));
}

std::uint64_t ClusterCloud::clusters_for(std::uint64_t points) {
  return points / points_of_a_cluster(points) + 1;
}

std::uint64_t ClusterCloud::bytes_for(std::uint64_t points) {
  return points * (sizeof(PackedPoint) + sizeof(std::uint32_t)) +
         clusters_for(points) * (sizeof(ClusterBox) + kLevels * sizeof(float));
}

}  // namespace stipple
