// What a small buffer held, told to the CPU when the GPU gets there.
#pragma once

#include <cstddef>

#include "render/gpu/buffer.h"

namespace stipple {

// One copy at a time is under way; nobody waits for it.
class LateCopy {
 public:
  // Of the first `bytes` of buffers. Throws Error when memory is refused.
  explicit LateCopy(std::size_t bytes);
  ~LateCopy() { forget(); }
  LateCopy(const LateCopy&) = delete;
  LateCopy& operator=(const LateCopy&) = delete;

  // Has the GPU copy what the buffer holds after all commands before this one, unless a copy is under way.
  void begin(const GpuBuffer& from);
  // Whether a copy has come since the last call; then it is in `to`.
  bool arrived(void* to);
  // The copy under way is not wanted.
  void forget();

 private:
  GpuBuffer copy_;
  const void* mapped_ = nullptr;
  GLsync done_ = nullptr;
};

}  // namespace stipple
