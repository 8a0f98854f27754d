#include "src/viewer/display.h"

#include <array>
#include <vector>

namespace stipple {
namespace {

glm::vec3 color_of(std::uint32_t rrggbb) {
  return glm::vec3(rrggbb >> 16 & 0xFFu, rrggbb >> 8 & 0xFFu, rrggbb & 0xFFu) / 255.0f;
}

}  // namespace

Display::Display() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  no_vertices_ = Handle<gl_delete::vertex_array>(name);
}

const Program& Display::program(bool split, bool packed) {
  std::optional<Program>& program = programs_[split][packed];
  if (!program) {
    std::vector<ShaderDefine> defines;
    if (split) defines.push_back({"SPLIT"});
    if (packed) defines.push_back({"PACKED"});
    program = Program::graphics("display_vertex.glsl", "display_fragment.glsl", defines);
  }
  return *program;
}

void Display::draw(const Scene& scene, const glm::ivec2& size, bool upside_down) {
  if (!scene.two_eyes) return draw(scene, size, 0, upside_down);
  const std::array<const FeedbackTarget*, 2> frames{scene.left, scene.right};
  const std::array<int, 3> columns{0, size.x / 2, size.x};
  for (std::size_t eye = 0; eye < 2; ++eye) {
    Scene half = scene;
    half.left = frames[eye];
    half.right = nullptr;
    half.wires[0] = scene.wires[eye];
    draw(half, {columns[eye + 1] - columns[eye], size.y}, columns[eye], upside_down);
  }
}

void Display::draw(const Scene& scene, const glm::ivec2& size, int first_column, bool upside_down) {
  glDisable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_SCISSOR_TEST);
  glViewport(first_column, 0, size.x, size.y);
  std::array<const Texture2D*, 2> packed = scene.packed;
  if (scene.eye_dome && !packed[0]) {
    packed[0] = &eye_domes_[0].shade(*scene.left, *scene.eye_dome);
    if (scene.right) packed[1] = &eye_domes_[1].shade(*scene.right, *scene.eye_dome);
  }
  program(scene.right, packed[0]).use();
  const auto bind = [&](const FeedbackTarget& frame, const Texture2D* colors, GLuint unit) {
    (colors ? *colors : frame.points()).bind(unit);
    frame.ids().bind(unit + 1);
  };
  bind(*scene.left, packed[0], 0);
  if (scene.right) {
    bind(*scene.right, packed[1], 2);
    glUniform1i(3, scene.divider);
  }
  const glm::vec3 background = color_of(scene.background);
  glUniform3f(0, background.x, background.y, background.z);
  glUniform2i(1, size.x, size.y);
  glUniform1i(2, upside_down);
  glUniform1i(4, first_column);
  glMemoryBarrier(GL_TEXTURE_FETCH_BARRIER_BIT);
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_TRIANGLES, 0, 3);
  const int border = scene.right ? scene.divider : size.x;
  wire_painter_.draw(scene.wires[0], *scene.left, scene.near, size, {0, border}, first_column, upside_down);
  if (scene.right)
    wire_painter_.draw(scene.wires[1], *scene.right, scene.near, size, {border, size.x}, first_column, upside_down);
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
  const glm::ivec2 size = scene.left->size() * glm::ivec2(scene.two_eyes ? 2 : 1, 1);
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
