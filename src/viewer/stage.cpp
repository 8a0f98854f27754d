#include "src/viewer/stage.h"

#include <utility>

#include "octree/core/error.h"

namespace stipple {
namespace {

bool same(const Grid& a, const Grid& b) {
  return a.offset == b.offset && a.scale == b.scale;
}

bool same(const ColorMap& a, const ColorMap& b) {
  return a.attribute == b.attribute && a.kind == b.kind && a.low == b.low && a.high == b.high;
}

}  // namespace

Stage::Stage(Workshop& workshop, RasterizerKind rasterizer, double point_size)
    : workshop_(workshop), rasterizer_(rasterizer), point_size_(point_size) {}

void Stage::open(const Opening& opening, bool again) {
  // What is shown lives on without them
  ready_.clear();
  asked_ = {opening.mode};
  preview_.reset();
  again_ = again;
  new_points_ = true;
  wanted_ = opening.mode;
  error_.clear();
  workshop_.open(opening);
}

void Stage::want(Mode mode) {
  wanted_ = mode;
  if (!info_ || shown_mode_ == mode) return;
  if (const auto ready = ready_.find(mode); ready != ready_.end()) {
    show(ready->second, mode, ready->second.dataset->points.grid, ready->second.dataset->colors);
  } else if (asked_.insert(mode).second) {
    workshop_.make(mode);
  }
}

void Stage::set_point_size(double pixels) {
  const double before = std::exchange(point_size_, pixels);
  if (!renderer_ || pixels == before) return;
  if (!make_renderer()) point_size_ = before;
}

void Stage::take(const finished::Beginning& beginning) {
  info_ = beginning.info;
  if (!again_) preview_ = std::make_shared<Preview>();
}

void Stage::take(const finished::Preview& preview) {
  if (!preview_) return;
  preview_->add(preview.points);
  report_.converged = false;
  if (new_points_) show({preview_, nullptr}, std::nullopt, info_->grid, preview.points.colors);
}

void Stage::take(const finished::Cloud& cloud) {
  dataset_ = cloud.dataset;
  info_ = cloud.dataset->info;
}

void Stage::take(finished::MadeMethod made) {
  asked_.erase(made.mode);
  const auto entry = ready_.insert_or_assign(made.mode, Ready{std::move(made.method), std::move(made.dataset)}).first;
  // What is not wanted is better than nothing, or than what is old
  if (made.mode == wanted_ || new_points_ || preview_)
    show(entry->second, made.mode, entry->second.dataset->points.grid, entry->second.dataset->colors);
}

void Stage::take(const finished::Failure& failure) {
  error_ = failure.message;
  if (failure.mode)
    asked_.erase(*failure.mode);
  else
    asked_.clear();
  if (shown_mode_ && !asked_.contains(wanted_)) wanted_ = *shown_mode_;
}

void Stage::show(Ready next, std::optional<Mode> mode, const Grid& grid, const ColorMap& colors) {
  const bool keep = renderer_ && !new_points_ && same(grid, grid_) && same(colors, colors_);
  // The old method has to live until the renderer has let go of it
  const Ready before = std::exchange(shown_, std::move(next));
  shown_mode_ = mode;
  grid_ = grid;
  colors_ = colors;
  new_points_ = false;
  if (mode) preview_.reset();
  drawn_view_ = {};
  if (keep)
    renderer_->use(*shown_.method);
  else if (!make_renderer())
    renderer_.reset();
}

bool Stage::make_renderer() {
  try {
    renderer_ = std::make_unique<ProgressiveRenderer>(*shown_.method, rasterizer_, grid_, point_size_);
    drawn_view_ = {};
    return true;
  } catch (const Error& e) {
    error_ = e.what();
    return false;
  }
}

void Stage::draw(const View& view, std::uint32_t budget) {
  if (!renderer_) return;
  if (view != drawn_view_) {
    drawn_view_ = view;
    view_points_ = 0;
  }
  report_ = renderer_->draw(view, budget);
  view_points_ += report_.points_filled;
  ++frames_;
}

}  // namespace stipple
