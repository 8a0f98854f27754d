// T16's single vertex buffer: allocated once, one section of it refilled each frame.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "render/frame/point_set.h"
#include "render/raster/rasterizer.h"

namespace stipple {

// Consecutive points in main memory.
struct PointPiece {
  const PackedPoint* points = nullptr;
  const std::uint32_t* ids = nullptr;  // null: point i has id first_id + i
  std::uint32_t first_id = 0;
  std::uint32_t count = 0;
  bool one_pixel = false;  // see PointRange
};

class StreamBuffer {
 public:
  // Sections of `section_points` points each (at most kLargestSection). Throws Error when memory is refused.
  explicit StreamBuffer(std::uint32_t section_points);
  ~StreamBuffer();
  StreamBuffer(const StreamBuffer&) = delete;
  StreamBuffer& operator=(const StreamBuffer&) = delete;

  static constexpr std::uint32_t kLargestSection = 1u << 22;
  std::uint32_t section_points() const { return section_points_; }

  // Copies the pieces, at most section_points() in all, into the next section on all cores and gives the range that
  // draws them, which knows nothing of their `one_pixel`. Waits until the GPU has finished with the frame that used the
  // section last.
  PointRange stream(std::span<const PointPiece> pieces);

 private:
  // While the GPU draws from one section the CPU fills the other.
  static constexpr std::size_t kSections = 2;

  std::uint32_t section_points_;
  std::size_t section_ = 0;
  GpuBuffer points_;
  GpuBuffer ids_;
  PackedPoint* mapped_points_ = nullptr;
  std::uint32_t* mapped_ids_ = nullptr;
  std::array<GLsync, kSections> in_use_{};
};

}  // namespace stipple
