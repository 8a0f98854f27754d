// S19's reproject buffer: the visible points of the last frame as whole vertices.
#pragma once

#include "render/frame/feedback_target.h"
#include "render/gpu/program.h"
#include "render/raster/rasterizer.h"

namespace stipple {

class VertexCarry {
 public:
  // Room for a vertex a pixel. Throws Error when a picture of this size needs a larger buffer than shaders can reach.
  explicit VertexCarry(const glm::ivec2& size);

  // The prepare pass: collects the points of a finished frame.
  void prepare(const FeedbackTarget& frame);
  // What prepare() collected.
  CarriedVertices vertices() const { return {&points_, &ids_, &command_}; }

 private:
  GpuBuffer points_;
  GpuBuffer ids_;
  GpuBuffer command_;
  Program prepare_;
  Program finish_;
};

// Pixels that show a point. Waits for the GPU: not for timed parts.
class CoverageCounter {
 public:
  CoverageCounter();
  std::uint32_t count(const Texture2D& ids);

 private:
  GpuBuffer counter_;
  Program program_;
};

}  // namespace stipple
