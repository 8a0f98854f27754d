// What can be chosen about a streaming build, and what it reports in the end.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "octree/build/stream/monitor.h"
#include "octree/cloud/grid.h"
#include "octree/store/potree2/format.h"

namespace stipple {

// How inner nodes choose their points: see sampler.h for what each guarantees.
enum class Sampling : std::uint8_t { poisson = 0, random = 1 };

struct StreamOptions {
  std::uint64_t memory = std::uint64_t{4} << 30;  // bytes the process may keep resident; kLeastMemory or more
  int threads = 0;                                // 0: one a core. Fewer are used where the memory allows no more
  Sampling sampling = Sampling::poisson;
  // brotli: a half to two thirds of the bytes; parts of nodes can no longer be read, and building takes longer.
  potree2::Encoding encoding = potree2::Encoding::uncompressed;
  std::size_t leaf_capacity = 40'000;  // a cell with more points is divided; 1 or more
  std::size_t cluster_points = 2'000;  // about as many in each cluster; 1 or more
  std::uint64_t seed = 0;              // of sampling and shuffling
  // Points of the largest cells that are built as one; changes the order of nodes in the file, never their points.
  std::size_t chunk_points = std::size_t{1} << 17;
  // Points held at once, where memory would allow more; no less than a chunk. Tests spill small clouds with it.
  std::uint64_t most_in_memory = std::numeric_limits<std::uint64_t>::max();
  bool replace = false;  // a tree that is already there
};

// Below this there is no room for the program, a batch of points, and the nodes that wait for their neighbours.
inline constexpr std::uint64_t kLeastMemory = std::uint64_t{128} << 20;

struct PhaseTime {
  BuildPhase phase = BuildPhase::counting;
  double seconds = 0.0;
};

struct BuildReport {
  std::uint64_t points = 0;
  std::uint64_t nodes = 0;
  int depth = 0;  // deepest level
  double spacing = 0.0;
  Grid grid;
  double largest_rounding = 0.0;  // world units; 0: every position is kept exactly
  std::uint64_t bytes_read = 0;
  std::uint64_t bytes_written = 0;  // spilled ones included
  std::uint64_t bytes_spilled = 0;
  std::vector<PhaseTime> phases;
};

}  // namespace stipple
