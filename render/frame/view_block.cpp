#include "render/frame/view_block.h"

#include <limits>

namespace stipple {

ViewBlock make_view_block(const View& view, const Grid& grid, const PointSize& point_size, double snapping) {
  const glm::dvec3 cell =
      glm::clamp(glm::floor(grid.grid_from_world(view.eye)), glm::dvec3(std::numeric_limits<std::int32_t>::min()),
                 glm::dvec3(std::numeric_limits<std::int32_t>::max()));
  const glm::ivec3 eye_cell(cell);
  ViewBlock block;
  block.eye_half = glm::ivec4(eye_cell >> 1, 0);
  block.eye_odd = glm::ivec4(eye_cell & 1, 0);
  block.grid_scale = glm::vec4(glm::vec3(grid.scale), 0.0f);
  block.eye_residual = glm::vec4(glm::vec3(view.eye - grid.world_from_grid(cell)), 0.0f);
  block.right = glm::vec4(glm::vec3(view.right * view.cot_x), 0.0f);
  block.down = glm::vec4(glm::vec3(-view.up * view.cot_y), 0.0f);
  block.forward = glm::vec4(glm::vec3(view.forward), 0.0f);
  block.size = view.size;
  block.near = static_cast<float>(view.near);
  block.point_size = static_cast<float>(point_size.pixels);
  block.splat_at_near = static_cast<float>(point_size.splat_at_one(view) / view.near);
  block.largest_splat = static_cast<float>(PointSize::kLargestSplat);
  block.snapping = static_cast<float>(snapping);
  block.padding = 0.0f;
  return block;
}

}  // namespace stipple
