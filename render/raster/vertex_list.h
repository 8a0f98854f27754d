// Points that a shader collects: whole vertices in a buffer, drawn by a command that counts them.
#pragma once

#include <cstddef>

#include "render/gpu/program.h"
#include "render/raster/rasterizer.h"

namespace stipple {

// The buffers of shaders/vertex_list.glsl. Move-only.
class VertexList {
 public:
  // Room for so many points. Throws Error when memory is refused.
  explicit VertexList(std::size_t capacity);

  std::size_t capacity() const { return points_.bytes() / sizeof(PackedPoint); }
  // Empties the list and binds it for shaders that append to it.
  void begin();
  // After them: makes the command that draws what they appended.
  void finish();
  CarriedVertices vertices() const { return {&points_, &ids_, &command_}; }

 private:
  GpuBuffer points_;
  GpuBuffer ids_;
  GpuBuffer command_;
  Program finish_;
};

}  // namespace stipple
