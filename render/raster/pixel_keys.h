// Depth and id of a pixel in one 64-bit number, which one atomic operation settles.
#pragma once

#include <optional>

#include "render/frame/feedback_target.h"
#include "render/gpu/buffer.h"
#include "render/gpu/program.h"

namespace stipple {

// Whether this driver's shaders have 64-bit atomics on buffers (GL_NV_shader_atomic_int64).
bool has_64_bit_atomics();

// The keys of shaders/pixel_keys.glsl, as many as the largest target yet has pixels.
class PixelKeys {
 public:
  PixelKeys();
  // Binds the keys of the target's pixels, which show its picture, or nothing where it is not drawn over. The target's
  // depth and ids must be bound as images 0 and 1.
  void begin(const FeedbackTarget& target, bool over_picture);

 private:
  GpuBuffer keys_;
  Program load_;
};

}  // namespace stipple
