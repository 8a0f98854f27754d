#include "src/viewer/pane.h"

#include <utility>

namespace stipple {
namespace {

bool same(const Grid& a, const Grid& b) {
  return a.offset == b.offset && a.scale == b.scale;
}

bool same(const ColorMap& a, const ColorMap& b) {
  return a.attribute == b.attribute && a.kind == b.kind && a.low == b.low && a.high == b.high;
}

}  // namespace

std::unique_ptr<ProgressiveRenderer> Pane::make_renderer(const Content& content, const PointSize& point_size) const {
  return std::make_unique<ProgressiveRenderer>(*content.method, rasterizer_, content.grid, point_size);
}

void Pane::show(Content next, bool other_points) {
  const bool keep = renderer_ && !other_points && same(next.grid, content_.grid) && same(next.colors, content_.colors);
  if (keep) {
    renderer_->use(*next.method);
    content_ = std::move(next);
  } else {
    auto renderer = make_renderer(next, point_size_);
    renderer_ = std::move(renderer);
    content_ = std::move(next);
  }
  drawn_view_ = {};
}

void Pane::set_point_size(double pixels) {
  const PointSize point_size(pixels, point_size_.world);
  if (renderer_) renderer_ = make_renderer(content_, point_size);
  point_size_ = point_size;
  drawn_view_ = {};
}

void Pane::draw(const View& view, std::uint32_t budget) {
  if (at_rest(view)) return;
  if (view != drawn_view_) {
    drawn_view_ = view;
    view_points_ = 0;
  }
  report_ = renderer_->draw(view, budget);
  view_points_ += report_.points_filled;
  ++frames_;
}

}  // namespace stipple
