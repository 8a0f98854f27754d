// Frames: when there is one to draw, how much of it, and what is shown of it.
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "src/viewer/viewer.h"

namespace stipple {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::uint32_t kFirstFrameBudget = 100'000;
constexpr std::size_t kFramesPlotted = 120;
// A camera that has not moved for so long stands still.
constexpr double kStillSeconds = 0.15;
// Points a frame of a still view, at least: nobody waits for its next frame, all wait for its last.
constexpr std::uint32_t kLeastStillBudget = 200'000;
// With no more points a frame than that, pixels are what takes its time.
constexpr std::uint32_t kLeastMovingBudget = 20'000;

}  // namespace

void Viewer::notice_motion() {
  const Camera& now = rig_.camera();
  if (now.eye == last_camera_.eye && now.target == last_camera_.target && now.up == last_camera_.up) return;
  last_camera_ = now;
  moved_at_ = window_.seconds();
}

bool Viewer::moving() const {
  return moved_at_ >= 0.0 && window_.seconds() - moved_at_ < kStillSeconds;
}

std::uint32_t Viewer::budget() const {
  if (!controller_) return options_.policy.points;
  return moving() ? controller_->budget() : std::max(controller_->budget(), kLeastStillBudget);
}

void Viewer::set_policy(const BudgetPolicy& policy) {
  options_.policy = policy;
  const std::uint32_t first = controller_ ? controller_->budget() : kFirstFrameBudget;
  controller_.reset();
  if (policy.frames_per_second)
    controller_.emplace(1000.0 / *policy.frames_per_second, first, BudgetController::Limits{});
}

void Viewer::draw_cloud() {
  const View fine = view();
  const bool coarse = moving() && controller_ && resolution_.divisor() > 1;
  const View next = coarse ? rig_.view(glm::max(size_ / resolution_.divisor(), 1)) : fine;
  if (stage_.at_rest(next)) return;
  stage_.draw(next, budget());
  hover_stale_ = true;
  if (stage_.at_rest(fine)) frames_to_show_ = kFramesAfterEvent;
}

void Viewer::show_frame() {
  size_ = glm::max(window_.size(), 1);
  notice_motion();
  if (stage_.at_rest(view()) && frames_to_show_ == 0) return;
  const auto start = Clock::now();
  const std::uint64_t frames_before = stage_.frames();
  const bool was_moving = moving();
  draw_cloud();
  if (stage_.frame())
    display_.show(scene(), size_);
  else
    display_.clear(options_.background, size_);
  show_panels();
  glFinish();
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  if (stage_.frames() > frames_before) learn_from(ms, was_moving);
  ask_under_cursor();
  // The last frame of panels that are settled
  if (frames_to_show_ <= 1) take_screenshot_if_due();
  window_.swap();
  ++frames_shown_;
  frames_to_show_ = std::max(frames_to_show_ - 1, 0);

  const double now = window_.seconds();
  const double between = now - std::exchange(last_frame_, now);
  // After a pause the rate begins anew
  frame_seconds_ = between > 0.5 || frame_seconds_ == 0.0 ? 1e-3 * ms : 0.8 * frame_seconds_ + 0.2 * between;
}

void Viewer::learn_from(double ms, bool was_moving) {
  if (frame_ms_.size() == kFramesPlotted) frame_ms_.erase(frame_ms_.begin());
  frame_ms_.push_back(static_cast<float>(ms));
  if (!controller_ || stage_.pane().mode() == Mode::brute_force) return;
  const bool least = controller_->budget() <= kLeastMovingBudget;
  controller_->frame_done(stage_.filled(), ms);
  if (was_moving) resolution_.frame_done(ms, least, 1000.0 / *options_.policy.frames_per_second);
}

void Viewer::show_panels() {
  gui_.begin_frame();
  const WorkStatus work = workshop_.status();
  const PanelWishes wishes = show_panel({.stage = stage_,
                                         .work = work,
                                         .picks = picks_,
                                         .view = view(),
                                         .frames_per_second = frame_seconds_ > 0.0 ? 1.0 / frame_seconds_ : 0.0,
                                         .frame_ms = frame_ms_,
                                         .budget = budget(),
                                         .policy = options_.policy,
                                         .point_size = options_.point_size,
                                         .background = options_.background,
                                         .divider = shows_both() ? std::optional(divider_column()) : std::nullopt,
                                         .right_alone = shown_sides_ == Shown::right,
                                         .under_cursor = under_cursor_,
                                         .recent = options_.recent,
                                         .note = note_,
                                         .panel_shown = options_.panel_shown,
                                         .keys_shown = keys_shown_,
                                         .scale = window_.text_scale()});
  gui_.end_frame();
  grant(wishes);
}

void Viewer::grant(const PanelWishes& wishes) {
  for (const Command command : wishes.commands) execute(command);
  if (wishes.mode) stage_.want(wishes.mode->first, wishes.mode->second);
  if (wishes.color) reopen(*wishes.color);
  if (wishes.point_size) set_point_size(*wishes.point_size);
  if (wishes.background) options_.background = *wishes.background;
  if (wishes.policy) set_policy(*wishes.policy);
  if (wishes.open) open(*wishes.open);
  if (wishes.dismiss_error) stage_.dismiss_error();
}

}  // namespace stipple
