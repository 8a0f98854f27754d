#include "octree/build/box_count.h"

#include "octree/build/morton.h"

namespace stipple {

BoxCounts box_counts(std::span<const CodedPoint> sorted) {
  BoxCounts counts;
  if (sorted.empty()) return counts;
  // Cells that begin on a level and not on one above; equal codes begin nothing, counted past the end.
  std::array<std::uint32_t, kMaxLevel + 2> begin{};
  begin[0] = 1;
  for (std::size_t i = 1; i < sorted.size(); ++i) ++begin[common_level(sorted[i - 1].code, sorted[i].code) + 1];
  std::uint32_t occupied = 0;
  for (int level = 0; level <= kMaxLevel; ++level) counts.occupied[level] = occupied += begin[level];
  return counts;
}

}  // namespace stipple
