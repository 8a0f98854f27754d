#include "render/frame/vertex_carry.h"

#include <fmt/format.h>

#include "octree/core/error.h"

namespace stipple {
namespace {

std::size_t pixels_of(const glm::ivec2& size) {
  return static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
}

std::size_t checked_pixels(const glm::ivec2& size) {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  const std::size_t bytes = pixels_of(size) * sizeof(PackedPoint);
  if (bytes > static_cast<std::size_t>(limit))
    throw Error(
        fmt::format("a picture of {}x{} pixels needs {} bytes for carried vertices; this driver's shaders reach "
                    "{}. Draw a smaller picture.",
                    size.x, size.y, bytes, limit));
  return pixels_of(size);
}

}  // namespace

VertexCarry::VertexCarry(const glm::ivec2& size)
    : points_(checked_pixels(size) * sizeof(PackedPoint)),
      ids_(pixels_of(size) * sizeof(std::uint32_t)),
      command_(sizeof(IndirectCommand)),
      prepare_(Program::compute("prepare.glsl")),
      finish_(Program::compute("finish_prepare.glsl")) {
  command_.fill(0);
}

void VertexCarry::prepare(const FeedbackTarget& frame) {
  command_.fill(0);
  points_.bind_storage(0);
  ids_.bind_storage(1);
  command_.bind_storage(2);
  prepare_.use();
  frame.points().bind(0);
  frame.carried_ids().bind(1);
  dispatch_pixels(frame.size());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  finish_.use();
  glUniform1ui(0, kRasterGroupSize);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_TEXTURE_FETCH_BARRIER_BIT | GL_COMMAND_BARRIER_BIT);
}

CoverageCounter::CoverageCounter() : counter_(16), program_(Program::compute("count_covered.glsl")) {}

std::uint32_t CoverageCounter::count(const Texture2D& ids) {
  counter_.fill(0);
  counter_.bind_storage(0);
  program_.use();
  ids.bind(1);
  dispatch_pixels(ids.size());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::uint32_t covered = 0;
  counter_.read(0, &covered, sizeof covered);
  return covered;
}

}  // namespace stipple
