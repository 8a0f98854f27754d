// What can be chosen about an octree.
#pragma once

#include <cstddef>
#include <cstdint>

namespace stipple {

struct BuildOptions {
  std::size_t leaf_capacity = 20'000;  // a cell with more points is divided; 1 or more
  std::size_t cluster_points = 2'000;  // about as many in each cluster; 1 or more
  std::uint64_t seed = 0;              // of sampling and shuffling
  // What one thread takes at a time; no influence on the result. 128 Ki points are 2 MiB, twice while sorting.
  std::size_t chunk_points = std::size_t{1} << 17;
};

}  // namespace stipple
