// Two-dimensional textures and framebuffers made of them.
#pragma once

#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "render/gpu/handle.h"

namespace stipple {

// One level, nearest filtering (integer formats know no other), edges clamped. Move-only.
class Texture2D {
 public:
  Texture2D() = default;
  // `format`: sized internal format. Contents are undefined. Throws Error when the driver refuses the size.
  Texture2D(GLenum format, const glm::ivec2& size);

  GLuint name() const { return handle_.name(); }
  const glm::ivec2& size() const { return size_; }

  void bind(GLuint unit) const { glBindTextureUnit(unit, name()); }
  void bind_image(GLuint unit, GLenum access) const {
    glBindImageTexture(unit, name(), 0, GL_FALSE, 0, access, format_);
  }

 private:
  Handle<gl_delete::texture> handle_;
  GLenum format_ = GL_NONE;
  glm::ivec2 size_{0};
};

// Copies the texture to main memory, row 0 first: `out` has room for pixel_bytes a pixel. Waits for the GPU.
void read_texture(const Texture2D& texture, GLenum format, GLenum type, std::size_t pixel_bytes, void* out);

// Colour attachments 0, 1, ... and an optional depth attachment. Does not own the textures. Move-only.
class Framebuffer {
 public:
  Framebuffer() = default;
  Framebuffer(std::span<const Texture2D* const> colors, const Texture2D* depth);

  GLuint name() const { return handle_.name(); }

 private:
  Handle<gl_delete::framebuffer> handle_;
};

}  // namespace stipple
