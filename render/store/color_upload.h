// New colours for points that lie on the GPU. Source: S19, section 4 (attributes streamed on demand): switching the
// attribute moves 4 bytes a point, positions never.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/frame/feedback_target.h"
#include "render/frame/point_set.h"
#include "render/gpu/buffer.h"
#include "render/gpu/program.h"

namespace stipple {

// Points on the GPU with their ids beside them.
struct ColoredPoints {
  const GpuBuffer* points = nullptr;  // PackedPoint
  const GpuBuffer* ids = nullptr;     // uint32 a point
};

class ColorUpload {
 public:
  // colors[i] becomes the colour of the point with id i, wherever it lies. Throws Error when memory is refused.
  explicit ColorUpload(std::span<const std::uint32_t> colors);

  // Points whose ids have no colour here keep theirs.
  void paint(const ColoredPoints& points) const;
  void paint(const FeedbackTarget& picture) const;

  // Sent to the GPU, whatever is painted with them.
  std::uint64_t bytes() const { return bytes_; }

 private:
  struct Piece {
    GpuBuffer colors;
    std::uint32_t first;  // id
    std::uint32_t count;
  };
  std::vector<Piece> pieces_;  // as large as any driver's shaders reach
  std::uint64_t bytes_;
  Program points_;
  Program picture_;
};

// The colours of these points by their ids, which must be 0, 1, ... in any order: throws Error for others, which points
// of an octree on disk have.
Buffer<std::uint32_t> colors_by_id(const PointSet& points);

}  // namespace stipple
