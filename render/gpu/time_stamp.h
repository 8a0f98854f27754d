// When the GPU got somewhere.
#pragma once

#include <cstddef>

#include "render/gpu/buffer.h"

namespace stipple {

// A moment of the GPU's own work, which the CPU need not know. Move-only.
class TimeStamp {
 public:
  TimeStamp();

  // The moment at which all commands before this one are done.
  void take() { glQueryCounter(query_.name(), GL_TIMESTAMP); }
  // Has the GPU write the moment taken last, in nanoseconds, as 64 bits to this place (bytes, a multiple of 8). The CPU
  // does not wait. It must have been taken before.
  void write_to(const GpuBuffer& buffer, std::size_t offset) const;

 private:
  Handle<gl_delete::query> query_;
};

}  // namespace stipple
