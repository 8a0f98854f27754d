#include "render/store/cluster_cut.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "octree/build/builder.h"
#include "octree/select/density.h"
#include "render/store/cluster_table.h"

namespace stipple {
namespace {

// An octree of a single leaf: its clusters follow the Morton curve.
Octree flat_octree(const Grid& grid, const GridBox& bounds, std::span<const PackedPoint> points,
                   std::size_t cluster_points) {
  BuildOptions options;
  options.leaf_capacity = std::numeric_limits<std::size_t>::max();
  options.cluster_points = cluster_points;
  return build_octree(grid, bounds, PositionView(points, &PackedPoint::position), options);
}

}  // namespace

ClusterCut cut_clusters(const Grid& grid, const GridBox& bounds, std::span<const PackedPoint> points,
                        std::size_t cluster_points, double root_edge) {
  Octree octree = flat_octree(grid, bounds, points, cluster_points);
  ClusterCut cut;
  cut.order = std::move(octree.order);
  cut.log_pixels.resize(octree.clusters.size() * ClusterTable::kLevels);
  cut.shards.resize(octree.clusters.size());
  for (const Cluster& cluster : octree.clusters) cut.clusters.push_back({cluster.first, cluster.count, cluster.box});
  tbb::parallel_for(std::size_t{0}, octree.clusters.size(), [&](std::size_t i) {
    const Cluster& cluster = octree.clusters[i];
    cut.shards[i] =
        deal_to_shards(grid, std::span(cut.order).subspan(cluster.first, cluster.count), points, cluster.box);
    for (std::size_t level = 0; level < ClusterTable::kLevels; ++level) {
      const double pixel = root_edge * std::exp2(-static_cast<double>(level));
      const double pixels = estimated_pixels(cluster.profile, octree.cube.edge, pixel);
      cut.log_pixels[i * ClusterTable::kLevels + level] = static_cast<float>(std::log2(std::max(pixels, 1.0)));
    }
  });
  return cut;
}

}  // namespace stipple
