// Lines over the picture: boxes of what a method draws from, and the pyramid that a camera saw.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <vector>

#include "octree/cloud/grid.h"
#include "render/frame/camera.h"
#include "render/frame/feedback_target.h"
#include "render/gpu/buffer.h"
#include "render/gpu/program.h"
#include "render/method/sighted_box.h"

namespace stipple {

// An end of a line as a view sees it; two make a line. Layout of shaders/wires_vertex.glsl.
struct WireEnd {
  glm::vec4 clip{0.0f};
  std::uint32_t rgba = 0;
  std::array<std::uint32_t, 3> padding{};
};
static_assert(sizeof(WireEnd) == 32);

// Of each state as PackedPoint::rgba, in the order of SightedBox::State.
inline constexpr std::array<std::uint32_t, 4> kBoxColors{0xFFA0A0A0u, 0xFF40C8FFu, 0xFF70D060u, 0xFF4848E8u};

// The twelve edges of each box; of more than kMostBoxes those nearest to `eye`.
inline constexpr std::size_t kMostBoxes = 5'000;
std::vector<WireEnd> wires_of(std::vector<SightedBox> boxes, const Grid& grid, const glm::dvec3& eye, const View& view);
// What `seen` sees up to `depth` world units away, as `view` sees it from elsewhere.
std::vector<WireEnd> wires_of(const View& seen, double depth, const View& view);

class WirePainter {
 public:
  WirePainter();
  // Over the framebuffer that is bound, in columns [first, end) of a picture of this size, which shows `frame` from
  // `first_column` of the framebuffer on.
  void draw(std::span<const WireEnd> wires, const FeedbackTarget& frame, double near, const glm::ivec2& size,
            const glm::ivec2& columns, int first_column, bool upside_down);

 private:
  std::optional<Program> from_image_;
  std::optional<Program> from_attachment_;
  GpuBuffer buffer_;
  Handle<gl_delete::vertex_array> no_vertices_;
};

}  // namespace stipple
