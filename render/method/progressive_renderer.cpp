#include "render/method/progressive_renderer.h"

#include <fmt/format.h>

#include <cmath>

#include "octree/core/error.h"

namespace stipple {
namespace {

int pixels_of(const FeedbackTarget& frame) {
  return frame.size().x * frame.size().y;
}

}  // namespace

ProgressiveRenderer::ProgressiveRenderer(Method& method, RasterizerKind rasterizer, const Grid& grid,
                                         const PointSize& point_size)
    : method_(&method),
      rasterizer_(make_rasterizer(rasterizer, point_size.varies())),
      grid_(grid),
      point_size_(point_size) {
  const glm::dvec2 sizes = rasterizer_->point_sizes();
  if (!(point_size.pixels > 0.0 && point_size.pixels >= sizes.x && point_size.pixels <= sizes.y))
    throw UsageError(fmt::format("point size {}: rasterizer {} draws points of {} to {} pixels here", point_size.pixels,
                                 name_of(rasterizer), sizes.x, sizes.y));
  if (!(point_size.world >= 0.0 && std::isfinite(point_size.world)))
    throw UsageError(fmt::format("splat size {}: must be 0 or above", point_size.world));
  // GL_POINTS are drawn a pixel larger on each side than the splat
  if (point_size.world > 0.0 && PointSize::kLargestSplat + 2.0 > sizes.y)
    throw UsageError(
        fmt::format("splat size {}: rasterizer {} draws points of up to {} pixels here, and splats may take "
                    "{}. Draw with --raster compute.",
                    point_size.world, name_of(rasterizer), sizes.y, PointSize::kLargestSplat + 2.0));
  if (point_size.spreads()) once_.emplace();
  method.set_point_size(point_size_);
}

void ProgressiveRenderer::resize(const glm::ivec2& size) {
  for (auto& target : targets_) target.emplace(size, rasterizer_->depth_storage());
  blank_ = true;
  vertices_.reset();
  if (method_->carry() == Carry::vertices) make_carry(current());
  method_->forget();
}

void ProgressiveRenderer::make_carry(const FeedbackTarget& frame) {
  vertices_.emplace(frame.size());
  carry_room_ = pixels_of(frame);
}

void ProgressiveRenderer::choose_carried(FeedbackTarget& frame) {
  if (once_) once_->choose(frame);
}

void ProgressiveRenderer::use(Method& method) {
  method_ = &method;
  method_->set_point_size(point_size_);
  method_->forget();
  if (!targets_[0]) return;
  vertices_.reset();
  if (method_->carry() == Carry::vertices) make_carry(current());
  if (view_.size == glm::ivec2(0)) return;
  if (method_->carry() == Carry::indices) {
    choose_carried(current());
    method_->frame_drawn(current());
  }
  view_drawn_ = false;
  method_->start_view(view_);
}

void ProgressiveRenderer::append_carry(std::vector<DrawItem>& items) {
  switch (method_->carry()) {
    case Carry::none:
      break;
    case Carry::grid:
      // Points of all sizes keep each other waiting where most pixels of the grid carry none
      if (once_) return append_vertices(items);
      items.push_back(CarriedGrid{&previous()});
      break;
    case Carry::vertices:
      append_vertices(items);
      break;
    case Carry::indices:
      break;
  }
}

void ProgressiveRenderer::append_vertices(std::vector<DrawItem>& items) {
  if (!vertices_ || carry_room_ < pixels_of(previous())) make_carry(previous());
  choose_carried(previous());
  vertices_->prepare(previous());
  items.push_back(vertices_->vertices());
}

void ProgressiveRenderer::warm_up(const glm::ivec2& size) {
  if (!targets_[0] || size != current().size()) resize(size);
  GpuBuffer point(sizeof(PackedPoint));
  const PackedPoint black{glm::ivec3(0), 0xFF000000u};
  point.write(0, &black, sizeof black);
  GpuBuffer zero(sizeof(std::uint32_t));
  zero.fill(0);
  const std::vector<DrawItem> items{PointRange{.points = &point, .count = 1},
                                    PickedPoints{.points = &point, .ids = &zero, .places = &zero, .count = 1}};
  // The point lies in front of the eye, so that no pass ends early
  const View view{.eye = grid_.world_from_grid(glm::ivec3(0)) - glm::dvec3(0, 10, 0), .near = 1.0, .size = size};
  uniforms_.set(make_view_block(view, grid_, point_size_));
  rasterizer_->draw(previous(), items);
  std::vector<DrawItem> carried = method_->warm_up(view, previous());
  append_carry(carried);
  rasterizer_->draw(current(), carried);
  if (method_->keeps_still_view()) rasterizer_->add(current(), items);
  for (auto& target : targets_) target->clear();
  blank_ = true;
  coverage_.count(current().ids());
  method_->forget();
  view_ = {};
  glFinish();
}

void ProgressiveRenderer::recolor(const ColorUpload& colors) {
  if (!targets_[0]) return;
  for (const auto& target : targets_) colors.paint(*target);
}

FrameReport ProgressiveRenderer::draw(const View& view, std::uint32_t budget) {
  if (view != view_) {
    if (!targets_[0]) resize(view.size);
    view_ = view;
    view_drawn_ = false;
    method_->start_view(view);
  }
  // A view of nothing is finished before it begins, but the last view's picture must go
  if (view_drawn_ && method_->finished()) return {0, true};

  uniforms_.set(make_view_block(view, grid_, point_size_));
  kept_ = view_drawn_ && method_->keeps_still_view();
  if (!kept_) {
    current_ = 1 - current_;
    if (current().size() != view.size) targets_[current_].emplace(view.size, rasterizer_->depth_storage());
  }
  const bool by_what_is_carried = !kept_ && !blank_ && method_->selects_by_what_is_carried();
  if (by_what_is_carried) {
    std::vector<DrawItem> carried;
    append_carry(carried);
    rasterizer_->draw(current(), carried);
    method_->carry_drawn(current());
  }
  Selection selection = method_->select(budget);
  if (kept_ || by_what_is_carried) {
    rasterizer_->add(current(), selection.items);
  } else {
    if (!blank_) append_carry(selection.items);
    rasterizer_->draw(current(), selection.items);
  }
  if (method_->carry() == Carry::indices) choose_carried(current());
  method_->frame_drawn(current());
  blank_ = false;
  view_drawn_ = true;
  return {selection.points, method_->finished()};
}

FrameData ProgressiveRenderer::read() {
  return current().read(view_.near);
}

std::uint64_t ProgressiveRenderer::covered_pixels() {
  return coverage_.count(current().ids());
}

std::uint64_t ProgressiveRenderer::points_reprojected() {
  return kept_ || method_->carry() == Carry::none ? 0 : coverage_.count(previous().carried_ids());
}

}  // namespace stipple
