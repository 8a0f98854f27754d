#include "render/raster/vertex_list.h"

namespace stipple {

VertexList::VertexList(std::size_t capacity)
    : points_(capacity * sizeof(PackedPoint)),
      ids_(capacity * sizeof(std::uint32_t)),
      command_(sizeof(IndirectCommand)),
      finish_(Program::compute("finish_list.glsl")) {
  command_.fill(0);
}

void VertexList::begin() {
  command_.fill(0);
  points_.bind_storage(0);
  ids_.bind_storage(1);
  command_.bind_storage(2);
}

void VertexList::finish() {
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  finish_.use();
  glUniform1ui(0, kRasterGroupSize);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

}  // namespace stipple
