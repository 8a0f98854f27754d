#include "render/store/tree_ids.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <numeric>
#include <vector>

#include "octree/build/hash.h"
#include "octree/core/error.h"

namespace stipple {

std::uint32_t first_id_of(const StoredNode& node) {
  if (node.points >= kNoPoint)
    throw Error(
        fmt::format("node {} has {} points; ids of 32 bits tell {} apart", name_of(node), node.points, kNoPoint - 1));
  const std::uint64_t xy = std::uint64_t{node.cell.x} << 32 | node.cell.y;
  const std::uint64_t z_level = std::uint64_t{node.cell.z} << 32 | static_cast<std::uint32_t>(node.level);
  // The upper half, scaled so that the last point's id stays below kNoPoint
  const std::uint64_t hash = mix64(mix64(xy) ^ z_level) >> 32;
  return static_cast<std::uint32_t>(hash * (kNoPoint - node.points) >> 32);
}

Buffer<std::uint32_t> ids_of(std::span<const StoredNode> nodes) {
  std::vector<std::uint64_t> begin(nodes.size() + 1);
  for (std::size_t i = 0; i < nodes.size(); ++i) begin[i + 1] = begin[i] + nodes[i].points;
  Buffer<std::uint32_t> ids(begin.back());
  tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t i) {
    std::iota(ids.begin() + static_cast<std::ptrdiff_t>(begin[i]),
              ids.begin() + static_cast<std::ptrdiff_t>(begin[i + 1]), first_id_of(nodes[i]));
  });
  return ids;
}

}  // namespace stipple
