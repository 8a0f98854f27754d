#include "src/viewer/pane.h"

#include <utility>

namespace stipple {
namespace {

bool same(const Grid& a, const Grid& b) {
  return a.offset == b.offset && a.scale == b.scale;
}

}  // namespace

std::unique_ptr<ProgressiveRenderer> Pane::make_renderer(Method& method, const Grid& grid,
                                                         const PointSize& point_size) const {
  return std::make_unique<ProgressiveRenderer>(method, rasterizer_, grid, point_size);
}

const FeedbackTarget* Pane::frame(std::size_t eye) const {
  if (frozen_ && frozen_->renderer->frame()) return frozen_->renderer->frame(eye);
  return renderer_ ? renderer_->frame(eye) : nullptr;
}

void Pane::show(Content next, bool other_points) {
  const bool keep = renderer_ && !other_points && same(next.grid, content_.grid) && next.colors == content_.colors;
  if (keep) {
    renderer_->use(*next.method);
    content_ = std::move(next);
  } else {
    auto renderer = make_renderer(*next.method, next.grid, point_size_);
    renderer_ = std::move(renderer);
    content_ = std::move(next);
  }
  thaw();
}

void Pane::recolor(const ColorUpload& colors, std::shared_ptr<const Dataset> dataset) {
  const bool selects = dataset->colors.hidden != content_.colors.hidden;
  content_.colors = dataset->colors;
  if (frozen_) {
    frozen_->points->recolor(colors, dataset->points);
    frozen_->renderer->recolor(colors);
    if (selects) frozen_->renderer->use(*frozen_->points);
  }
  renderer_->recolor(colors);
  if (selects) {
    renderer_->use(*content_.method);
    drawn_view_ = {};
  }
  if (content_.dataset) content_.dataset = std::move(dataset);
}

void Pane::set_point_size(const PointSize& point_size) {
  if (renderer_) {
    auto renderer = make_renderer(*content_.method, content_.grid, point_size);
    if (frozen_) frozen_->renderer = make_renderer(*frozen_->points, content_.grid, point_size);
    renderer_ = std::move(renderer);
  }
  point_size_ = point_size;
  drawn_view_ = {};
}

void Pane::freeze() {
  if (frozen_ || !frame()) return;
  Still still{.points = std::make_unique<Frozen>(*frame()), .boxes = boxes(), .renderer = nullptr};
  still.renderer = make_renderer(*still.points, content_.grid, point_size_);
  frozen_ = std::move(still);
  drawn_view_ = {};
}

void Pane::thaw() {
  frozen_.reset();
  drawn_view_ = {};
}

std::vector<SightedBox> Pane::boxes() const {
  if (frozen_) return frozen_->boxes;
  return content_.method ? content_.method->boxes() : std::vector<SightedBox>{};
}

std::uint64_t Pane::draw(const View& view, std::uint32_t budget) {
  if (at_rest(view)) return 0;
  if (view != drawn_view_) {
    drawn_view_ = view;
    view_points_ = 0;
  }
  report_ = (frozen_ ? *frozen_->renderer : *renderer_).draw(view, budget);
  view_points_ += report_.points_filled;
  ++frames_;
  return report_.points_filled;
}

std::uint64_t Pane::draw_more(std::uint32_t budget) {
  if (!adds_to_frames() || report_.converged) return 0;
  const std::uint64_t before = report_.points_filled;
  report_ = renderer_->draw_more(budget);
  const std::uint64_t drawn = report_.points_filled;
  view_points_ += drawn;
  report_.points_filled += before;
  return drawn;
}

}  // namespace stipple
