// Building a kd tree on disk, to compare the partition of binary-tree viewers with the octree.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "octree/build/stream/monitor.h"
#include "octree/build/stream/options.h"
#include "octree/cloud/source.h"

namespace stipple {

// Writes a kd tree of all points of `sources`, with all their attributes, to `folder`, which appears when all of it is
// on the disk, as build_tree() does; octree/store/potree2/kd_boxes.h says how it is stored. Leaves hold all points
// (kd_partition.h), but for an even sample in the root, by which whoever opens the tree chooses colours and views. The
// points of a node stand in clusters, as in our octrees.
//
// All points are held in memory: their records and 36 bytes each. Throws Error where options.memory is less than that,
// for options out of range or that octrees alone know (sampling other than the default, encoding brotli), and as
// build_tree() does.
BuildReport build_kd_tree(std::span<const std::unique_ptr<PointSource>> sources, const std::string& folder,
                          const StreamOptions& options, BuildMonitor& monitor);

}  // namespace stipple
