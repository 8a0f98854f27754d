#include "render/method/progressive_renderer.h"

#include <fmt/format.h>

#include "octree/core/error.h"

namespace stipple {
namespace {

int pixels_of(const FeedbackTarget& frame) {
  return frame.size().x * frame.size().y;
}

}  // namespace

ProgressiveRenderer::ProgressiveRenderer(Method& method, RasterizerKind rasterizer, const Grid& grid, double point_size)
    : method_(&method),
      rasterizer_(make_rasterizer(rasterizer, point_size != 1.0)),
      grid_(grid),
      point_size_(point_size) {
  const glm::dvec2 sizes = rasterizer_->point_sizes();
  if (!(point_size > 0.0 && point_size >= sizes.x && point_size <= sizes.y))
    throw UsageError(fmt::format("point size {}: rasterizer {} draws points of {} to {} pixels here", point_size,
                                 name_of(rasterizer), sizes.x, sizes.y));
}

void ProgressiveRenderer::resize(const glm::ivec2& size) {
  for (auto& target : targets_) target.emplace(size, rasterizer_->depth_storage());
  blank_ = true;
  vertices_.reset();
  if (method_->carry() == Carry::vertices) make_carry();
  method_->forget();
}

void ProgressiveRenderer::make_carry() {
  vertices_.emplace(current().size());
  carry_room_ = pixels_of(current());
}

void ProgressiveRenderer::use(Method& method) {
  method_ = &method;
  method_->forget();
  if (!targets_[0]) return;
  vertices_.reset();
  if (method_->carry() == Carry::vertices) make_carry();
  if (view_.size == glm::ivec2(0)) return;
  if (method_->carry() == Carry::indices) method_->frame_drawn(current());
  view_drawn_ = false;
  method_->start_view(view_);
}

void ProgressiveRenderer::append_carry(std::vector<DrawItem>& items) {
  switch (method_->carry()) {
    case Carry::none:
      break;
    case Carry::grid:
      items.push_back(CarriedGrid{&previous()});
      break;
    case Carry::vertices:
      if (carry_room_ < pixels_of(previous())) make_carry();
      vertices_->prepare(previous());
      items.push_back(vertices_->vertices());
      break;
    case Carry::indices:
      break;
  }
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
  coverage_.count(current());
  method_->forget();
  view_ = {};
  glFinish();
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
  Selection selection = method_->select(budget);
  kept_ = view_drawn_ && method_->keeps_still_view();
  if (kept_) {
    rasterizer_->add(current(), selection.items);
  } else {
    current_ = 1 - current_;
    if (current().size() != view.size) targets_[current_].emplace(view.size, rasterizer_->depth_storage());
    if (!blank_) append_carry(selection.items);
    rasterizer_->draw(current(), selection.items);
  }
  method_->frame_drawn(current());
  blank_ = false;
  view_drawn_ = true;
  return {selection.points, method_->finished()};
}

FrameData ProgressiveRenderer::read() {
  return current().read(view_.near);
}

std::uint64_t ProgressiveRenderer::covered_pixels() {
  return coverage_.count(current());
}

std::uint64_t ProgressiveRenderer::points_reprojected() {
  return kept_ || method_->carry() == Carry::none ? 0 : coverage_.count(previous());
}

}  // namespace stipple
