#include "render/raster/points_rasterizer.h"

#include <array>
#include <cmath>

namespace stipple {
namespace {

Program compile_points(const std::vector<ShaderDefine>& defines) {
  return Program::graphics("raster_points_vertex.glsl", "raster_points_fragment.glsl", defines);
}

void draw_points(SourcePrograms& programs, std::span<const DrawItem> items) {
  for (const DrawItem& item : items) {
    programs.use_for(item);
    if (const auto command = command_of(item)) {
      glBindBuffer(GL_DRAW_INDIRECT_BUFFER, command->buffer->name());
      glDrawArraysIndirect(GL_POINTS, reinterpret_cast<const void*>(command->offset));
    } else if (const auto* grid = std::get_if<CarriedGrid>(&item)) {
      glDrawArraysInstanced(GL_POINTS, 0, grid->previous->size().x, grid->previous->size().y);
    } else {
      glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(item_capacity(item)));
    }
  }
}

GLuint make_vertex_array() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  return name;
}

}  // namespace

PointsRasterizer::PointsRasterizer(bool splats)
    : nearest_("PASS_NEAREST", splats, compile_points),
      claim_("PASS_CLAIM", splats, compile_points),
      repeat_("PASS_REPEAT", splats, compile_points),
      no_attributes_(make_vertex_array()),
      repeat_command_(4 * sizeof(std::uint32_t)) {}

glm::dvec2 PointsRasterizer::point_sizes() const {
  std::array<GLfloat, 2> range{};
  glGetFloatv(GL_POINT_SIZE_RANGE, range.data());
  return {range[0], range[1]};
}

double PointsRasterizer::snapping() const {
  GLint bits = 0;
  glGetIntegerv(GL_SUBPIXEL_BITS, &bits);
  return std::ldexp(1.0, -bits);
}

void PointsRasterizer::rasterize(FeedbackTarget& target, std::span<const DrawItem> items, bool) {
  const std::array<const Texture2D*, 2> colors{&target.points(), &target.ids()};
  const Framebuffer all(colors, &target.depth());
  const Framebuffer depth_only({}, &target.depth());

  glBindVertexArray(no_attributes_.name());
  glViewport(0, 0, target.size().x, target.size().y);
  glEnable(GL_DEPTH_TEST);

  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, all.name());
  glDepthMask(GL_TRUE);
  glDepthFunc(GL_GREATER);
  draw_points(nearest_, items);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);

  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, depth_only.name());
  glDepthMask(GL_FALSE);
  glDepthFunc(GL_EQUAL);
  target.ids().bind_image(1, GL_READ_WRITE);
  target.points().bind_image(2, GL_WRITE_ONLY);
  notes_.begin();
  draw_points(claim_, items);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
  notes_.settle();

  // Draws nothing unless the notes overflowed: the claim pass has set the number of instances
  for (const DrawItem& item : items) {
    const std::array<std::uint32_t, 4> command{static_cast<std::uint32_t>(item_capacity(item)), 0, 0, 0};
    repeat_command_.write(0, command.data(), sizeof command);
    glCopyNamedBufferSubData(notes_.buffer().name(), repeat_command_.name(), TieNotes::kRepeatInstancesOffset, 4, 4);
    repeat_.use_for(item);
    glBindBuffer(GL_DRAW_INDIRECT_BUFFER, repeat_command_.name());
    glDrawArraysIndirect(GL_POINTS, nullptr);
  }
  glDepthMask(GL_TRUE);
  glBindFramebuffer(GL_DRAW_FRAMEBUFFER, 0);
  glMemoryBarrier(GL_ALL_BARRIER_BITS);
}

}  // namespace stipple
