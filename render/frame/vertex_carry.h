// S19's reproject buffer: the visible points of the last frame as whole vertices.
#pragma once

#include "render/frame/feedback_target.h"
#include "render/raster/vertex_list.h"

namespace stipple {

class VertexCarry {
 public:
  // Room for a vertex a pixel. Throws Error when a picture of this size needs a larger buffer than shaders can reach.
  explicit VertexCarry(const glm::ivec2& size);

  // The prepare pass: collects the points of a finished frame.
  void prepare(const FeedbackTarget& frame);
  // What prepare() collected.
  CarriedVertices vertices() const { return list_.vertices(); }

 private:
  VertexList list_;
  Program prepare_;
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
