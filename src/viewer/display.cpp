#include "src/viewer/display.h"

#include <array>

namespace stipple {
namespace {

glm::vec3 color_of(std::uint32_t rrggbb) {
  return glm::vec3(rrggbb >> 16 & 0xFFu, rrggbb >> 8 & 0xFFu, rrggbb & 0xFFu) / 255.0f;
}

}  // namespace

Display::Display()
    : one_(Program::graphics("display_vertex.glsl", "display_fragment.glsl")),
      two_(Program::graphics("display_vertex.glsl", "display_fragment.glsl", {{"SPLIT"}})) {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  no_vertices_ = Handle<gl_delete::vertex_array>(name);
}

void Display::draw(const Scene& scene, const glm::ivec2& size, bool upside_down) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, size.x, size.y);
  (scene.right ? two_ : one_).use();
  scene.left->points().bind(0);
  scene.left->ids().bind(1);
  if (scene.right) {
    scene.right->points().bind(2);
    scene.right->ids().bind(3);
    glUniform1i(3, scene.divider);
  }
  const glm::vec3 background = color_of(scene.background);
  glUniform3f(0, background.x, background.y, background.z);
  glUniform2i(1, size.x, size.y);
  glUniform1i(2, upside_down);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

void Display::show(const Scene& scene, const glm::ivec2& window_size) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  draw(scene, window_size, true);
}

void Display::clear(std::uint32_t background, const glm::ivec2& window_size) {
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  glDisable(GL_SCISSOR_TEST);
  glViewport(0, 0, window_size.x, window_size.y);
  const glm::vec3 color = color_of(background);
  glClearColor(color.x, color.y, color.z, 1.0f);
  glClear(GL_COLOR_BUFFER_BIT);
}

Image Display::picture(const Scene& scene) {
  const glm::ivec2 size = scene.left->size();
  const Texture2D colors(GL_RGBA8, size);
  const std::array<const Texture2D*, 1> attachments{&colors};
  const Framebuffer framebuffer(attachments, nullptr);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
  draw(scene, size, false);
  Image image{size, {}};
  image.rgb.resize(3 * static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
  glReadPixels(0, 0, size.x, size.y, GL_RGB, GL_UNSIGNED_BYTE, image.rgb.data());
  glBindFramebuffer(GL_FRAMEBUFFER, 0);
  return image;
}

}  // namespace stipple
