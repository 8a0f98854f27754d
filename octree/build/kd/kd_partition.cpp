#include "octree/build/kd/kd_partition.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

#include "octree/cloud/longest_axis.h"
#include "octree/store/tree_store.h"

namespace stipple {
namespace {

// Makes the node's box tight, and orders its points for its children. Returns how many are the lower child's; 0 for
// a leaf.
std::size_t divide(const Grid& grid, const PositionView& positions, std::span<CodedPoint> own,
                   std::size_t leaf_capacity, KdNode& node) {
  for (const CodedPoint& point : own) node.box.extend(positions[point.id]);
  if (own.size() <= leaf_capacity || node.level == kMaxStoredLevel || node.box.min == node.box.max) return 0;
  const int axis = longest_axis(grid, node.box);
  std::int64_t sum = 0;  // of at most 2^32 values of 32 bits
  for (const CodedPoint& point : own) sum += positions[point.id][axis];
  const double mean = static_cast<double>(sum) / static_cast<double>(own.size());
  // Rounded, the mean of huge coordinates may be at an end, or beyond: both children get something all the same
  const auto limit = std::clamp(static_cast<std::int64_t>(std::floor(mean)), std::int64_t{node.box.min[axis]},
                                std::int64_t{node.box.max[axis]} - 1);
  const auto upper =
      std::partition(own.begin(), own.end(), [&](const CodedPoint& p) { return positions[p.id][axis] <= limit; });
  return static_cast<std::size_t>(upper - own.begin());
}

}  // namespace

std::vector<KdNode> kd_partition(const Grid& grid, const PositionView& positions, std::span<CodedPoint> points,
                                 std::size_t leaf_capacity) {
  std::vector<KdNode> nodes;
  if (points.empty()) return nodes;
  nodes.push_back({.count = points.size()});
  for (std::size_t first = 0; first < nodes.size();) {
    const std::size_t end = nodes.size();
    std::vector<std::size_t> lower(end - first);
    tbb::parallel_for(first, end, [&](std::size_t i) {
      KdNode& node = nodes[i];
      lower[i - first] = divide(grid, positions, points.subspan(node.first, node.count), leaf_capacity, node);
    });
    for (std::size_t i = first; i < end; ++i) {
      const std::size_t count = lower[i - first];
      if (count == 0) continue;
      const KdNode node = nodes[i];
      nodes[i].children = static_cast<std::uint32_t>(nodes.size());
      nodes.push_back({.level = node.level + 1, .first = node.first, .count = count});
      nodes.push_back({.level = node.level + 1, .first = node.first + count, .count = node.count - count});
    }
    first = end;
  }
  return nodes;
}

}  // namespace stipple
