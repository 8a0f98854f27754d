// A whole cloud on the GPU in clusters.
#pragma once

#include <cstdint>

#include "render/frame/point_set.h"
#include "render/store/cluster_cut.h"
#include "render/store/cluster_table.h"

namespace stipple {

// Clusters cut from the whole cloud are smaller and tighter than those of an octree's nodes, whose upper levels spread
// a sample over large cells: such boxes are hardly ever hidden (docs/decisions/0011-hybrid.md). Takes
// kBytesPerPointOfOctree a point in main memory while it works. Throws Error when memory is refused.
ClusterTable upload_clusters(const PointSet& points);
// The two halves of it: what takes the time, which needs no OpenGL, and the rest.
ClusterCut cut_cloud(const PointSet& points);
ClusterTable upload_clusters(const PointSet& points, const ClusterCut& cut);

// About as many clusters are made of so many points.
std::uint64_t clusters_for(std::uint64_t points);
// Bytes of GPU memory that they take.
std::uint64_t cluster_bytes_for(std::uint64_t points);

}  // namespace stipple
