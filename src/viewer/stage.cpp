#include "src/viewer/stage.h"

#include <utility>

#include "octree/core/error.h"

namespace stipple {
namespace {

constexpr std::array kSides{Stage::left, Stage::right};

}  // namespace

Stage::Stage(Workshop& workshop, RasterizerKind rasterizer, const PointSize& point_size)
    : workshop_(workshop), panes_{Pane(rasterizer, point_size), Pane(rasterizer, point_size)} {}

void Stage::open(const Opening& opening, bool again) {
  // What is shown lives on in the panes
  ready_.clear();
  preview_.reset();
  again_ = again;
  opened_ = false;
  outdated_ = {true, true};
  error_.clear();
  wanted_[left] = opening.mode;
  if (wanted_[right] == opening.mode) wanted_[right] = opening.mode == Mode::hybrid ? Mode::unstructured : Mode::hybrid;
  asked_ = {opening.mode};
  workshop_.open(opening);
  if (split_) want(wanted_[right], right);
}

bool Stage::can_recolor() const {
  return opened_ && !dataset_->tree;
}

void Stage::recolor(const ColorChoice& color) {
  error_.clear();
  workshop_.recolor(color);
}

void Stage::want(Mode mode, Side side) {
  const Side other = side == left ? right : left;
  if (split_ && wanted_[other] == mode && wanted_[side] != mode) {
    std::swap(wanted_[left], wanted_[right]);
    std::swap(panes_[left], panes_[right]);
    std::swap(outdated_[left], outdated_[right]);
    return;
  }
  wanted_[side] = mode;
  if (!info_ || (panes_[side].mode() == mode && !outdated_[side])) return;
  if (const auto ready = ready_.find(mode); ready != ready_.end())
    show(side, ready->second);
  else if (asked_.insert(mode).second)
    workshop_.make(mode);
}

void Stage::split(bool on) {
  split_ = on;
  if (!on) return;
  if (wanted_[right] == wanted_[left])
    wanted_[right] = wanted_[left] == Mode::hybrid ? Mode::unstructured : Mode::hybrid;
  want(wanted_[right], right);
}

void Stage::set_point_size(const PointSize& point_size) {
  try {
    for (Pane& pane : panes_) pane.set_point_size(point_size);
  } catch (const Error& e) {
    error_ = e.what();
  }
}

void Stage::freeze(bool on) {
  try {
    for (Pane& pane : panes_) on ? pane.freeze() : pane.thaw();
  } catch (const Error& e) {
    error_ = e.what();
  }
}

void Stage::begin_again() {
  for (Pane& pane : panes_) pane.begin_again();
}

void Stage::take(const finished::Beginning& beginning) {
  info_ = beginning.info;
  if (!again_) preview_ = std::make_shared<Preview>();
}

void Stage::take(const finished::Preview& preview) {
  if (!preview_) return;
  preview_->add(preview.points);
  if (outdated_[left])
    show(left, {preview_, nullptr, std::nullopt, info_->grid, preview.points.colors});
  else
    panes_[left].wake();
}

void Stage::take(const finished::Cloud& cloud) {
  dataset_ = cloud.dataset;
  info_ = cloud.dataset->info;
  opened_ = true;
}

void Stage::take(const finished::Colors& colors) {
  dataset_ = colors.dataset;
  color_bytes_ = colors.upload->bytes();
  std::set<Method*> recolored;
  const auto recolor = [&](Method& method) {
    if (recolored.insert(&method).second) method.recolor(*colors.upload, dataset_->points);
  };
  for (auto& [mode, content] : ready_) {
    recolor(*content.method);
    content.dataset = dataset_;
    content.colors = dataset_->colors;
  }
  for (const Side side : kSides) {
    if (panes_[side].empty() || outdated_[side]) continue;
    recolor(*panes_[side].content().method);
    panes_[side].recolor(*colors.upload, dataset_);
  }
}

void Stage::take(finished::MadeMethod made) {
  asked_.erase(made.mode);
  const auto& content = ready_
                            .insert_or_assign(made.mode, Pane::Content{std::move(made.method), made.dataset, made.mode,
                                                                       made.dataset->points.grid, made.dataset->colors})
                            .first->second;
  // What is not wanted is better than nothing, or than what is old
  const bool better = outdated_[left] || !panes_[left].mode();
  if (made.mode == wanted_[left] || (better && !(split_ && made.mode == wanted_[right])))
    show(left, content);
  else if (split_ && made.mode == wanted_[right])
    show(right, content);
}

void Stage::take(const finished::Failure& failure) {
  error_ = failure.message;
  if (failure.mode)
    asked_.erase(*failure.mode);
  else if (!failure.recoloring)
    asked_.clear();
  for (const Side side : kSides) {
    const std::optional<Mode> shown = panes_[side].mode();
    if (shown && !asked_.contains(wanted_[side])) wanted_[side] = *shown;
  }
  if (split_ && panes_[right].empty() && !asked_.contains(wanted_[right])) split_ = false;
}

void Stage::show(Side side, const Pane::Content& content) {
  try {
    panes_[side].show(content, outdated_[side]);
    freeze(false);
    outdated_[side] = false;
    if (content.mode) preview_.reset();
  } catch (const Error& e) {
    error_ = e.what();
  }
}

std::uint32_t Stage::share_of(std::uint32_t budget) const {
  return std::max(budget / static_cast<std::uint32_t>(sides()), 1u);
}

std::uint64_t Stage::draw(const View& view, std::uint32_t budget) {
  std::uint64_t drawn = 0;
  for (std::size_t side = 0; side < sides(); ++side) drawn += panes_[side].draw(view, share_of(budget));
  return drawn;
}

bool Stage::adds_to_frames() const {
  return panes_[left].adds_to_frames() || (split_ && panes_[right].adds_to_frames());
}

std::uint64_t Stage::draw_more(std::uint32_t budget) {
  std::uint64_t drawn = 0;
  for (std::size_t side = 0; side < sides(); ++side) drawn += panes_[side].draw_more(share_of(budget));
  return drawn;
}

Unread Stage::unread() const {
  Unread unread;
  for (std::size_t side = 0; side < sides(); ++side) unread.add(panes_[side].unread());
  return unread;
}

bool Stage::at_rest(const View& view) const {
  return panes_[left].at_rest(view) && (!split_ || panes_[right].at_rest(view));
}

bool Stage::complete(const View& view) const {
  if (!at_rest(view)) return false;
  for (const Side side : kSides)
    if ((side == left || split_) && panes_[side].mode() != wanted_[side]) return false;
  return true;
}

std::uint64_t Stage::filled() const {
  return panes_[left].filled() + (split_ ? panes_[right].filled() : 0);
}

std::uint64_t Stage::frames() const {
  return panes_[left].frames() + panes_[right].frames();
}

}  // namespace stipple
