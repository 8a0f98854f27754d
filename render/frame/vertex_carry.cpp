#include "render/frame/vertex_carry.h"

#include <fmt/format.h>

namespace stipple {
namespace {

std::size_t checked_pixels(const glm::ivec2& size) {
  const std::size_t pixels = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y);
  check_shader_storage(pixels * sizeof(PackedPoint),
                       fmt::format("the carried vertices of a picture of {}x{} pixels", size.x, size.y),
                       "Draw a smaller picture.");
  return pixels;
}

}  // namespace

VertexCarry::VertexCarry(const glm::ivec2& size)
    : list_(checked_pixels(size)), prepare_(Program::compute("prepare.glsl")) {}

void VertexCarry::prepare(const FeedbackTarget& frame) {
  list_.begin();
  prepare_.use();
  frame.points().bind(0);
  frame.carried_ids().bind(1);
  dispatch_columns(frame.size());
  list_.finish();
}

CoverageCounter::CoverageCounter() : counter_(16), program_(Program::compute("count_covered.glsl")) {}

std::uint32_t CoverageCounter::count(const Texture2D& ids) {
  counter_.fill(0);
  counter_.bind_storage(0);
  program_.use();
  ids.bind(1);
  dispatch_columns(ids.size());
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  std::uint32_t covered = 0;
  counter_.read(0, &covered, sizeof covered);
  return covered;
}

}  // namespace stipple
