// Buffers of the GPU.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "render/gpu/handle.h"

namespace stipple {

// Immutable storage of fixed size. Move-only.
class GpuBuffer {
 public:
  GpuBuffer() = default;
  // `flags` as in glNamedBufferStorage. Contents are undefined until written. Throws Error when memory is refused.
  explicit GpuBuffer(std::size_t bytes, GLbitfield flags = GL_DYNAMIC_STORAGE_BIT);

  GLuint name() const { return handle_.name(); }
  std::size_t bytes() const { return bytes_; }

  void write(std::size_t offset, const void* data, std::size_t bytes);
  template <class T>
  void write(std::size_t offset, std::span<const T> data) {
    write(offset, data.data(), data.size_bytes());
  }
  void read(std::size_t offset, void* data, std::size_t bytes) const;
  // Fills the range with a repeated 32-bit value. Offset and size in bytes, multiples of 4.
  void fill(std::uint32_t value, std::size_t offset, std::size_t bytes);
  void fill(std::uint32_t value) { fill(value, 0, bytes_); }
  // Fills all of it with four repeated values. The size must be a multiple of 16 bytes.
  void fill(const std::array<std::int32_t, 4>& values);

  void bind_storage(GLuint binding) const { glBindBufferBase(GL_SHADER_STORAGE_BUFFER, binding, name()); }
  void bind_storage(GLuint binding, std::size_t offset, std::size_t bytes) const;
  void bind_uniform(GLuint binding) const { glBindBufferBase(GL_UNIFORM_BUFFER, binding, name()); }
  // For shaders that read alone, which is a fifth faster on Mesa's software renderer (docs/decisions/0015). `format` as
  // in glTextureBuffer, the same whenever it is called.
  void bind_texels(GLuint unit, GLenum format) const;

 private:
  Handle<gl_delete::buffer> handle_;
  mutable Handle<gl_delete::texture> texels_;  // a view of it, once it was asked for
  std::size_t bytes_ = 0;
};

// Throws Error when shaders do not reach so many bytes of a buffer: "`what` take ... `remedy`".
void check_shader_storage(std::size_t bytes, std::string_view what, std::string_view remedy);

}  // namespace stipple
