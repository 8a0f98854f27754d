#include "render/frame/carry_once.h"

namespace stipple {

CarryOnce::CarryOnce()
    : mark_(Program::compute("carry_once.glsl", {{"MARK"}})), choose_(Program::compute("carry_once.glsl")) {}

void CarryOnce::choose(FeedbackTarget& frame) {
  const std::size_t bytes =
      static_cast<std::size_t>(frame.size().x) * static_cast<std::size_t>(frame.size().y) * sizeof(std::uint32_t);
  if (firsts_.bytes() != bytes) firsts_ = GpuBuffer(bytes);
  firsts_.fill(0xFFFFFFFFu);
  firsts_.bind_storage(0);
  frame.ids().bind(1);
  mark_.use();
  dispatch_pixels(frame.size());
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  frame.make_carried_ids().bind_image(0, GL_WRITE_ONLY);
  choose_.use();
  dispatch_pixels(frame.size());
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT | GL_SHADER_STORAGE_BARRIER_BIT);
}

}  // namespace stipple
