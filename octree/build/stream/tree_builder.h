// Building an octree on disk from clouds of any size, in bounded memory.
#pragma once

#include <memory>
#include <span>
#include <string>

#include "octree/build/stream/monitor.h"
#include "octree/build/stream/options.h"
#include "octree/cloud/source.h"

namespace stipple {

// Writes a Potree 2.0 tree of all points of `sources`, with all their attributes, and its sidecar to `folder`, which
// appears when all of it is on the disk: see potree2::WriterFolder for what is refused and replaced.
//
// The same points give the same bytes, whatever the order of files and points, threads, memory or machine, with one
// exception: the order inside a heap of points of one code that is larger than memory.
//
// Memory: options.memory bounds what the process has resident; 20 KiB a million points come on top for the list of
// nodes. What does not fit is spilled to a file without a name in the temporary folder.
//
// Stages: count cells -> distribute records to chunks, in memory or by way of the disk -> build chunks from the leaves
// up -> join the levels above as chunks finish, in Morton order -> hierarchy and metadata. Source of the ideas:
// Schuetz, Ohrhallinger, Wimmer, "Fast Out-of-Core Octree Generation for Massive Point Clouds", 2020.
//
// Throws Error when a source does, when the disk is full, when the build is stopped through `monitor`, for options out
// of range, and for memory too little; nothing is left behind then, and a tree that was there stays.
BuildReport build_tree(std::span<const std::unique_ptr<PointSource>> sources, const std::string& folder,
                       const StreamOptions& options, BuildMonitor& monitor);

}  // namespace stipple
