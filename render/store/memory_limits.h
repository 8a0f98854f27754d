// How much memory points may take while they are drawn.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

namespace stipple {

// Bytes for points, ids and hierarchies. The program, the driver and the pictures' buffers come on top.
struct MemoryLimits {
  static constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();
  std::uint64_t main = kNone;  // main memory
  std::uint64_t gpu = kNone;   // of the device that draws; on a software renderer, main memory again
};

// What a point costs. GPU: 16 bytes packed, 4 of id; twice that in a streamed section, of which one is drawn while the
// other is filled.
inline constexpr std::uint64_t kGpuBytesPerPoint = 20;
inline constexpr std::uint64_t kGpuBytesPerStreamedPoint = 2 * kGpuBytesPerPoint;
// Main memory, points streamed from disk: for each of a frame's budget three read ahead and one being copied, packed.
inline constexpr std::uint64_t kBytesPerStreamedPoint = 4 * 16;
// Main memory, a whole cloud: decoded position and colour, packed, while one becomes the other; the octree's codes,
// order and ids are built when the first are gone.
inline constexpr std::uint64_t kBytesPerPoint = 36;
inline constexpr std::uint64_t kBytesPerPointOfOctree = 56;

// The largest budget of points a frame that streams from an octree on disk within the limits; at least 1.
inline std::uint32_t budget_within(const MemoryLimits& limits, std::uint32_t budget) {
  const std::uint64_t fitting = std::min(limits.main / kBytesPerStreamedPoint, limits.gpu / kGpuBytesPerStreamedPoint);
  return static_cast<std::uint32_t>(std::clamp<std::uint64_t>(fitting, 1, budget));
}

}  // namespace stipple
