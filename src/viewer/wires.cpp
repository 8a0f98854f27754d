#include "src/viewer/wires.h"

#include <algorithm>

#include "octree/select/frustum.h"

namespace stipple {
namespace {

constexpr std::uint32_t kCameraColor = 0xFFFFFFFFu;

glm::vec4 clip_of(const View& view, const glm::dvec3& world) {
  const glm::dvec3 r = world - view.eye;
  return glm::dvec4(glm::dot(view.right, r) * view.cot_x, glm::dot(view.up, r) * view.cot_y, 0.0,
                    glm::dot(view.forward, r));
}

void append_box(const WorldBox& box, const View& view, std::uint32_t rgba, std::vector<WireEnd>& wires) {
  std::array<glm::vec4, 8> corners;
  for (int i = 0; i < 8; ++i)
    corners[static_cast<std::size_t>(i)] =
        clip_of(view, {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z});
  for (std::size_t from = 0; from < 8; ++from)
    for (const std::size_t axis : {1u, 2u, 4u}) {
      if (from & axis) continue;
      wires.push_back({corners[from], rgba});
      wires.push_back({corners[from | axis], rgba});
    }
}

}  // namespace

std::vector<WireEnd> wires_of(std::vector<SightedBox> boxes, const Grid& grid, const glm::dvec3& eye,
                              const View& view) {
  const auto nearer = [&](const SightedBox& a, const SightedBox& b) {
    return nearest_distance(eye, world_box(grid, a.box)) < nearest_distance(eye, world_box(grid, b.box));
  };
  if (boxes.size() > kMostBoxes) {
    std::ranges::nth_element(boxes, boxes.begin() + kMostBoxes, nearer);
    boxes.resize(kMostBoxes);
  }
  std::vector<WireEnd> wires;
  for (const SightedBox& box : boxes)
    append_box(world_box(grid, box.box), view, kBoxColors[static_cast<std::size_t>(box.state)], wires);
  return wires;
}

std::vector<WireEnd> wires_of(const View& seen, double depth, const View& view) {
  std::vector<WireEnd> wires;
  const auto line = [&](const glm::dvec3& from, const glm::dvec3& to) {
    wires.push_back({clip_of(view, from), kCameraColor});
    wires.push_back({clip_of(view, to), kCameraColor});
  };
  const auto corner = [&](double x, double y) {
    return seen.eye + depth * (seen.forward + seen.right * (x / seen.cot_x) + seen.up * (y / seen.cot_y));
  };
  const std::array corners{corner(-1, -1), corner(1, -1), corner(1, 1), corner(-1, 1)};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    line(seen.eye, corners[i]);
    line(corners[i], corners[(i + 1) % corners.size()]);
  }
  return wires;
}

WirePainter::WirePainter() {
  GLuint name = 0;
  glCreateVertexArrays(1, &name);
  no_vertices_ = Handle<gl_delete::vertex_array>(name);
}

void WirePainter::draw(std::span<const WireEnd> wires, const FeedbackTarget& frame, double near, const glm::ivec2& size,
                       const glm::ivec2& columns, int first_column, bool upside_down) {
  if (wires.empty()) return;
  const bool image = frame.depth_storage() == DepthStorage::image;
  std::optional<Program>& program = image ? from_image_ : from_attachment_;
  if (!program)
    program =
        Program::graphics("wires_vertex.glsl", "wires_fragment.glsl", {{image ? "FROM_IMAGE" : "FROM_ATTACHMENT"}});
  if (buffer_.bytes() < wires.size_bytes()) buffer_ = GpuBuffer(2 * wires.size_bytes());
  buffer_.write(0, wires);
  buffer_.bind_storage(0);
  program->use();
  frame.depth().bind(0);
  glUniform1i(0, upside_down);
  glUniform1f(1, static_cast<float>(near));
  glUniform2i(2, size.x, size.y);
  glUniform2i(3, columns.x, columns.y);
  glUniform1i(4, upside_down);
  glUniform1i(5, first_column);
  glEnable(GL_BLEND);
  glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
  glBindVertexArray(no_vertices_.name());
  glDrawArrays(GL_LINES, 0, static_cast<GLsizei>(wires.size()));
  glDisable(GL_BLEND);
}

}  // namespace stipple
