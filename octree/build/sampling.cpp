#include "octree/build/sampling.h"

#include <algorithm>
#include <vector>

namespace stipple {
namespace {

// The level of the nodes whose lattice has cells of `cell_level`. On the levels whose lattices would be finer than the
// finest cells, nothing is left to choose: the topmost of them took a point of every cell.
std::uint8_t node_level(int cell_level) {
  if (cell_level > kMaxLevel) return kNotSampled;
  return static_cast<std::uint8_t>(std::max(0, cell_level - kLatticeLevels));
}

}  // namespace

// A cell is a run of the sorted points. A point represents it when the run reaches neither the nearest point of lower
// rank before nor the one after, which a stack of falling ranks finds.
void sample_levels(std::span<const CodedPoint> sorted, std::span<std::uint8_t> level) {
  std::vector<std::size_t> open;  // no lower rank met yet; ranks ascend
  const auto below_common = [&](std::size_t a, std::size_t b) {
    return static_cast<std::uint8_t>(common_level(sorted[a].code, sorted[b].code) + 1);
  };
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    // Equal codes ascend in rank: all but the first represent nothing and outrank nobody that the first does not.
    if (i > 0 && sorted[i].code == sorted[i - 1].code) {
      level[i] = kNotSampled;
      continue;
    }
    while (!open.empty() && sorted[open.back()].rank > sorted[i].rank) {
      const std::size_t done = open.back();
      open.pop_back();
      level[done] = node_level(std::max(level[done], below_common(done, i)));
    }
    level[i] = open.empty() ? std::uint8_t{0} : below_common(open.back(), i);
    open.push_back(i);
  }
  for (const std::size_t i : open) level[i] = node_level(level[i]);
}

}  // namespace stipple
