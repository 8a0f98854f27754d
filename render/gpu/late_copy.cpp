#include "render/gpu/late_copy.h"

#include <fmt/format.h>

#include <cstring>

#include "octree/core/error.h"

namespace stipple {
namespace {

constexpr GLbitfield kReading = GL_MAP_READ_BIT | GL_MAP_PERSISTENT_BIT | GL_MAP_COHERENT_BIT;

}  // namespace

LateCopy::LateCopy(std::size_t bytes)
    : copy_(bytes, kReading),
      mapped_(glMapNamedBufferRange(copy_.name(), 0, static_cast<GLsizeiptr>(bytes), kReading)) {
  if (!mapped_) throw Error(fmt::format("the OpenGL driver cannot map a buffer of {} bytes", bytes));
}

void LateCopy::begin(const GpuBuffer& from) {
  if (done_) return;
  glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  glCopyNamedBufferSubData(from.name(), copy_.name(), 0, 0, static_cast<GLsizeiptr>(copy_.bytes()));
  done_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
}

bool LateCopy::arrived(void* to) {
  if (!done_) return false;
  const GLenum state = glClientWaitSync(done_, GL_SYNC_FLUSH_COMMANDS_BIT, 0);
  if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) return false;
  forget();
  std::memcpy(to, mapped_, copy_.bytes());
  return true;
}

void LateCopy::forget() {
  glDeleteSync(done_);
  done_ = nullptr;
}

}  // namespace stipple
