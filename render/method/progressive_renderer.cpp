#include "render/method/progressive_renderer.h"

#include <fmt/format.h>

#include <cmath>

#include "octree/core/error.h"
#include "render/method/steered_round.h"

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
      point_size_(point_size),
      eyes_(1) {
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
  for (Eye& eye : eyes_)
    for (auto& target : eye.targets) target.emplace(size, rasterizer_->depth_storage());
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
  if (!frame()) return;
  vertices_.reset();
  if (method_->carry() == Carry::vertices) make_carry(current());
  if (view_.size == glm::ivec2(0)) return;
  view_drawn_ = false;
  method_->start_view(view_);
}

void ProgressiveRenderer::append_carry(Carry carry, std::vector<DrawItem>& items, std::size_t eye) {
  carried_ = carry;
  switch (carry) {
    case Carry::none:
      break;
    case Carry::grid:
      // Points of all sizes keep each other waiting where most pixels of the grid carry none
      if (once_) return append_vertices(items, eye);
      items.push_back(CarriedGrid{&previous(eye)});
      break;
    case Carry::vertices:
      append_vertices(items, eye);
      break;
    case Carry::indices:
      choose_carried(previous(eye));
      method_->append_carried(previous(eye), items);
      break;
  }
}

void ProgressiveRenderer::append_vertices(std::vector<DrawItem>& items, std::size_t eye) {
  FeedbackTarget& last = previous(eye);
  if (!vertices_ || carry_room_ < pixels_of(last)) make_carry(last);
  choose_carried(last);
  vertices_->prepare(last);
  items.push_back(vertices_->vertices());
}

void ProgressiveRenderer::warm_up(const glm::ivec2& size, std::size_t eyes) {
  const bool as_it_is = frame() && size == current().size() && eyes == eyes_.size();
  eyes_.resize(eyes);
  if (!as_it_is) resize(size);
  GpuBuffer point(sizeof(PackedPoint));
  const PackedPoint black{glm::ivec3(0), 0xFF000000u};
  point.write(0, &black, sizeof black);
  GpuBuffer zero(sizeof(std::uint32_t));
  zero.fill(0);
  std::vector<DrawItem> items{PointRange{.points = &point, .count = 1},
                              PickedPoints{.points = &point, .ids = &zero, .places = &zero, .count = 1}};
  GpuBuffer command(sizeof(IndirectCommand));
  const IndirectCommand one{1, 1, 0, 0, 1, 1, 1, 0};
  command.write(0, &one, sizeof one);
  if (steered())
    items.push_back(SteeredRange{.points = &point, .ids = &zero, .commands = &command, .command = 0, .size = 1});
  // The point lies in front of the eye, so that no pass ends early
  const View view{.eye = grid_.world_from_grid(glm::ivec3(0)) - glm::dvec3(0, 10, 0),
                  .near = 1.0,
                  .size = size,
                  .eyes_apart = eyes == 2 ? 1.0 : 0.0};
  eyes_[0].block.set(make_view_block(view.of_eye(0), grid_, point_size_, rasterizer_->snapping()));
  rasterizer_->draw(previous(), items);
  method_->warm_up(view, previous());
  if (SteeredRound* const steered = method_->steered()) {
    method_->select(0);
    steered->drop_frame();
  }
  std::vector<DrawItem> carried;
  append_carry(method_->carry(), carried, 0);
  rasterizer_->draw(current(), carried);
  if (method_->keeps_still_view()) rasterizer_->add(current(), items);
  for (Eye& eye : eyes_)
    for (auto& target : eye.targets) target->clear();
  blank_ = true;
  coverage_.count(current().ids());
  method_->forget();
  view_ = {};
  glFinish();
}

void ProgressiveRenderer::recolor(const ColorUpload& colors) {
  for (const Eye& eye : eyes_)
    for (const auto& target : eye.targets)
      if (target) colors.paint(*target);
}

FrameReport ProgressiveRenderer::draw(const View& view, std::uint32_t budget) {
  if (view != view_) {
    if (!frame()) resize(view.size);
    eyes_.resize(view.eyes());
    view_ = view;
    view_drawn_ = false;
    method_->start_view(view);
  }
  SteeredRound* const steered = method_->steered();
  if (steered) steered->hear();
  // A view of nothing is finished before it begins, but the last view's picture must go
  if (view_drawn_ && method_->finished() && !method_->draws_on())
    return report_ = {.points_filled = steered ? steered->take_points() : 0, .converged = true, .budget = budget};

  begin_frame();
  const bool by_picture = !blank_ && method_->selects_by_picture();
  if (by_picture) show_picture(kept_);
  const std::uint64_t selected = draw_selected(budget, kept_ || by_picture);
  if (steered) steered->end_frame();
  blank_ = false;
  view_drawn_ = true;
  const std::uint64_t filled = steered ? steered->take_points() : selected;
  return report_ = {.points_filled = filled, .converged = method_->finished(), .budget = budget};
}

FrameReport ProgressiveRenderer::draw_more(std::uint32_t budget) {
  // A moving picture is another in the next frame: too soon to see again
  if (kept_ && method_->selects_by_picture()) show_picture(true);
  const std::uint64_t selected = draw_selected(budget, true);
  return report_ = {.points_filled = selected, .converged = method_->finished(), .budget = budget};
}

FrameReport ProgressiveRenderer::await_report() {
  if (SteeredRound* const steered = method_->steered()) {
    steered->await();
    report_.points_filled += steered->take_points();
    report_.converged = view_drawn_ && steered->finished();
    report_.budget = steered->budget();
  }
  return report_;
}

void ProgressiveRenderer::begin_frame() {
  kept_ = view_drawn_ && method_->keeps_still_view();
  if (!kept_) current_ = 1 - current_;
  carried_ = Carry::none;
  for (std::size_t number = 0; number < eyes_.size(); ++number) {
    Eye& eye = eyes_[number];
    eye.block.set(make_view_block(view_.of_eye(number), grid_, point_size_, rasterizer_->snapping()));
    auto& target = eye.targets[current_];
    if (!target || target->size() != view_.size) target.emplace(view_.size, rasterizer_->depth_storage());
  }
}

void ProgressiveRenderer::draw_carried(std::size_t eye) {
  std::vector<DrawItem> carried;
  append_carry(method_->carry(), carried, eye);
  rasterizer_->draw(current(eye), carried);
}

void ProgressiveRenderer::show_picture(bool carried) {
  for (std::size_t eye = 0; eye < eyes_.size(); ++eye) {
    eyes_[eye].block.bind();
    if (!carried) draw_carried(eye);
    method_->see(current(eye), eye);
  }
}

std::uint64_t ProgressiveRenderer::draw_selected(std::uint32_t budget, bool over_picture) {
  eyes_[0].block.bind();
  Selection selection = method_->select(budget);
  const bool has_nothing_yet = selection.points == 0 && !method_->finished();
  const Carry carry = method_->carry() == Carry::none && has_nothing_yet ? Carry::grid : method_->carry();
  std::vector<DrawItem>& items = selection.items;
  const auto selected = static_cast<std::ptrdiff_t>(items.size());
  for (std::size_t eye = 0; eye < eyes_.size(); ++eye) {
    eyes_[eye].block.bind();
    if (over_picture) {
      rasterizer_->add(current(eye), items);
    } else {
      if (!blank_) append_carry(carry, items, eye);
      rasterizer_->draw(current(eye), items);
      items.erase(items.begin() + selected, items.end());
    }
    method_->frame_drawn(current(eye), eye);
  }
  return selection.points;
}

FrameData ProgressiveRenderer::read(std::size_t eye) {
  return current(eye).read(view_.near);
}

std::uint64_t ProgressiveRenderer::covered_pixels(std::size_t eye) {
  return coverage_.count(current(eye).ids());
}

std::uint64_t ProgressiveRenderer::points_reprojected(std::size_t eye) {
  return carried_ == Carry::none ? 0 : coverage_.count(previous(eye).carried_ids());
}

}  // namespace stipple
