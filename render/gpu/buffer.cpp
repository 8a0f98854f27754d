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

}  // namespace stipple
