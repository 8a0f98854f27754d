#include "render/gpu/buffer.h"

#include <fmt/format.h>

#include "octree/core/error.h"

namespace stipple {

GpuBuffer::GpuBuffer(std::size_t bytes, GLbitfield flags) : bytes_(bytes) {
  GLuint name = 0;
  glCreateBuffers(1, &name);
  handle_ = Handle<gl_delete::buffer>(name);
  // A size of zero is an error in OpenGL; an empty buffer is none for us.
  glNamedBufferStorage(name, static_cast<GLsizeiptr>(bytes ? bytes : 16), nullptr, flags);
  GLint given = 0;
  glGetNamedBufferParameteriv(name, GL_BUFFER_IMMUTABLE_STORAGE, &given);
  if (!given) throw Error(fmt::format("the OpenGL driver refused a buffer of {} bytes: too little memory", bytes));
}

void GpuBuffer::write(std::size_t offset, const void* data, std::size_t bytes) {
  if (bytes) glNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

void GpuBuffer::read(std::size_t offset, void* data, std::size_t bytes) const {
  if (bytes) glGetNamedBufferSubData(name(), static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes), data);
}

void GpuBuffer::fill(std::uint32_t value, std::size_t offset, std::size_t bytes) {
  if (bytes)
    glClearNamedBufferSubData(name(), GL_R32UI, static_cast<GLintptr>(offset), static_cast<GLsizeiptr>(bytes),
                              GL_RED_INTEGER, GL_UNSIGNED_INT, &value);
}

void GpuBuffer::fill(const std::array<std::int32_t, 4>& values) {
  if (bytes_)
    glClearNamedBufferSubData(name(), GL_RGBA32I, 0, static_cast<GLsizeiptr>(bytes_), GL_RGBA_INTEGER, GL_INT,
                              values.data());
}

void GpuBuffer::bind_storage(GLuint binding, std::size_t offset, std::size_t bytes) const {
  glBindBufferRange(GL_SHADER_STORAGE_BUFFER, binding, name(), static_cast<GLintptr>(offset),
                    static_cast<GLsizeiptr>(bytes));
}

void GpuBuffer::bind_texels(GLuint unit, GLenum format) const {
  if (!texels_.name()) {
    GLuint texture = 0;
    glCreateTextures(GL_TEXTURE_BUFFER, 1, &texture);
    texels_ = Handle<gl_delete::texture>(texture);
    glTextureBuffer(texture, format, name());
  }
  glBindTextureUnit(unit, texels_.name());
}

void check_shader_storage(std::size_t bytes, std::string_view what, std::string_view remedy) {
  GLint64 limit = 0;
  glGetInteger64v(GL_MAX_SHADER_STORAGE_BLOCK_SIZE, &limit);
  if (bytes > static_cast<std::size_t>(limit))
    throw Error(fmt::format("{} take {} bytes; this driver's shaders reach {}. {}", what, bytes, limit, remedy));
}

}  // namespace stipple
