#include "render/gpu/texture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <vector>

#include "octree/core/error.h"

namespace stipple {

Texture2D::Texture2D(GLenum format, const glm::ivec2& size) : format_(format), size_(size) {
  GLuint name = 0;
  glCreateTextures(GL_TEXTURE_2D, 1, &name);
  handle_ = Handle<gl_delete::texture>(name);
  glTextureStorage2D(name, 1, format, size.x, size.y);
  GLint given = 0;
  glGetTextureParameteriv(name, GL_TEXTURE_IMMUTABLE_FORMAT, &given);
  if (!given)
    throw Error(
        fmt::format("the OpenGL driver refused a target of {}x{} pixels: draw a smaller picture", size.x, size.y));
  glTextureParameteri(name, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
  glTextureParameteri(name, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  glTextureParameteri(name, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
}

// In bands of rows: OpenGL counts the bytes of one call in 31 bits, less than a picture of 16384x16384 has.
void read_texture(const Texture2D& texture, GLenum format, GLenum type, std::size_t pixel_bytes, void* out) {
  constexpr std::size_t kBandBytes = 8u << 20;
  const glm::ivec2 size = texture.size();
  const std::size_t row_bytes = static_cast<std::size_t>(size.x) * pixel_bytes;
  const int rows = static_cast<int>(std::max<std::size_t>(1, kBandBytes / row_bytes));
  auto* place = static_cast<std::byte*>(out);
  for (int y = 0; y < size.y; y += rows) {
    const int count = std::min(rows, size.y - y);
    const std::size_t bytes = row_bytes * static_cast<std::size_t>(count);
    glGetTextureSubImage(texture.name(), 0, 0, y, 0, size.x, count, 1, format, type, static_cast<GLsizei>(bytes),
                         place);
    place += bytes;
  }
}

Framebuffer::Framebuffer(std::span<const Texture2D* const> colors, const Texture2D* depth) {
  GLuint name = 0;
  glCreateFramebuffers(1, &name);
  handle_ = Handle<gl_delete::framebuffer>(name);
  std::vector<GLenum> draw_buffers;
  for (const Texture2D* color : colors) {
    const GLenum attachment = GL_COLOR_ATTACHMENT0 + static_cast<GLenum>(draw_buffers.size());
    glNamedFramebufferTexture(name, attachment, color->name(), 0);
    draw_buffers.push_back(attachment);
  }
  if (depth) glNamedFramebufferTexture(name, GL_DEPTH_ATTACHMENT, depth->name(), 0);
  glNamedFramebufferDrawBuffers(name, static_cast<GLsizei>(draw_buffers.size()), draw_buffers.data());
  const GLenum status = glCheckNamedFramebufferStatus(name, GL_FRAMEBUFFER);
  if (status != GL_FRAMEBUFFER_COMPLETE)
    throw Error(fmt::format("the OpenGL driver rejects the feedback framebuffer (status 0x{:04x})", status));
}

}  // namespace stipple
