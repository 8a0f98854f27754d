#include "render/raster/pixel_keys.h"

#include <fmt/format.h>

namespace stipple {

bool has_64_bit_atomics() {
  return epoxy_has_gl_extension("GL_ARB_gpu_shader_int64") && epoxy_has_gl_extension("GL_NV_shader_atomic_int64");
}

PixelKeys::PixelKeys() : load_(Program::compute("load_keys.glsl")) {}

void PixelKeys::begin(const FeedbackTarget& target, bool over_picture) {
  const glm::ivec2 size = target.size();
  const std::size_t bytes = static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y) * sizeof(std::uint64_t);
  if (keys_.bytes() < bytes) {
    check_shader_storage(bytes, fmt::format("the keys of a picture of {}x{} pixels", size.x, size.y),
                         "Draw a smaller picture, or with --raster points.");
    keys_ = GpuBuffer(bytes);
  }
  keys_.bind_storage(5);
  if (over_picture) {
    load_.use();
    dispatch_pixels(size);
  } else {
    keys_.fill(0, 0, bytes);
  }
}

}  // namespace stipple
