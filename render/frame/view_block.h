// The uniform block of shaders/projection.glsl.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>

#include "octree/cloud/grid.h"
#include "render/frame/camera.h"
#include "render/frame/point_size.h"
#include "render/gpu/buffer.h"

namespace stipple {

// std140 layout of ViewBlock.
struct ViewBlock {
  glm::ivec4 eye_half;
  glm::ivec4 eye_odd;
  glm::vec4 grid_scale;
  glm::vec4 eye_residual;
  glm::vec4 right;
  glm::vec4 down;
  glm::vec4 forward;
  glm::ivec2 size;
  float near;
  float point_size;
  float splat_at_near;
  float largest_splat;
  float snapping;
  float padding;
};
static_assert(sizeof(ViewBlock) == 144);

// Of a view of one eye. The eye's cell is clamped to int32; what is beyond stays in the residual. `snapping`: see
// Rasterizer::snapping().
ViewBlock make_view_block(const View& view, const Grid& grid, const PointSize& point_size, double snapping = 0.0);

// The block on the GPU.
class ViewUniforms {
 public:
  ViewUniforms() : buffer_(sizeof(ViewBlock)) {}
  // Writes the block and binds it to binding 0, where every pass expects it.
  void set(const ViewBlock& block) {
    buffer_.write(0, &block, sizeof block);
    bind();
  }
  void bind() const { buffer_.bind_uniform(0); }

 private:
  GpuBuffer buffer_;
};

}  // namespace stipple
