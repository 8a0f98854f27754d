// How a build divides the memory it may use.
#pragma once

#include <cstddef>
#include <cstdint>

#include "octree/build/stream/options.h"

namespace stipple {

struct MemoryPlan {
  int threads = 1;
  std::uint64_t region_bytes = 0;  // records that are held at once, while they are built
  std::uint64_t part_bytes = 0;    // of the parts of a region that is larger, where its cells can be divided so far
  std::uint64_t spill_bytes = 0;   // of buffers, while points are spilled; region_bytes are not in use then
};

// Bytes of this process that are resident now.
std::uint64_t resident_bytes();

// Points of a chunk: those of the options, fewer of long records. Depends on nothing that may change between two builds
// of the same tree, and neither do the tree's bytes.
std::size_t chunk_points(const StreamOptions& options, std::size_t record_bytes);

// Makes malloc give large blocks back to the system as soon as they are freed, from now on and for the whole process,
// where memory is scarce: it keeps them otherwise, which is faster.
void keep_heap_small(std::uint64_t memory);

// Throws Error when options.memory is too little even for one thread.
MemoryPlan plan_memory(const StreamOptions& options, std::size_t record_bytes);

}  // namespace stipple
