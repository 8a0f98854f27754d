// Frames: when there is one to draw, how much of it, and what is shown of it.
#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>
#include <utility>

#include "octree/core/error.h"
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
  const View fine = wanted_view();
  const bool of_window = fine == view();
  const bool coarse = moving() && controller_ && resolution_.divisor() > 1 && of_window;
  const View next = coarse ? view_of(glm::max(size_ / resolution_.divisor(), 1)) : fine;
  if (stage_.at_rest(next)) return;
  if (std::exchange(drawn_view_, next) != next) comparison_.begin_view(window_.seconds());
  try {
    stage_.draw(next, budget());
  } catch (const Error& e) {
    // A picture for which there is no room is no reason to end
    if (of_window || options_.exit_after_screenshot) throw;
    screenshot_.clear();
    options_.screenshot_size.reset();
    note_ = e.what();
    stage_.begin_again();
  }
  hover_stale_ = true;
  if (stage_.at_rest(fine)) frames_to_show_ = kFramesAfterEvent;
}

// What is to be compared with the reference; none: there is nothing, or not all points are in memory.
std::optional<ReferencePainter::Subject> Viewer::compared() const {
  const std::shared_ptr<const Dataset>& dataset = stage_.pane().content().dataset;
  if (!comparison_.on() || two_eyes_ || !dataset || !dataset->in_memory()) return std::nullopt;
  return ReferencePainter::Subject{dataset, wanted_view(), options_.point_size};
}

// A reference is missing that has not been asked for: the camera has hardly stopped.
bool Viewer::compares_soon() const {
  const auto subject = compared();
  return subject && !comparison_.asked_for(*subject);
}

void Viewer::ask_for_reference() {
  if (!moving() && compares_soon()) comparison_.rest(*compared());
}

void Viewer::compare_frames() {
  differences_ = {};
  if (!compared() || drawn_view_ != wanted_view() || !comparison_.reference_of(drawn_view_)) return;
  for (const Stage::Side side : {Stage::left, Stage::right})
    if (stage_.frame(side) && (side == Stage::left || stage_.is_split()))
      differences_[side] = &comparison_.compare(side, *stage_.frame(side), stage_.pane(side).frames(),
                                                options_.background, window_.seconds());
}

void Viewer::lay_wires() {
  wires_ = {};
  box_counts_ = {};
  for (const std::size_t place : {0u, 1u}) {
    const Stage::Side side = place == 1 && !two_eyes_ ? Stage::right : Stage::left;
    if (!stage_.frame(side) || (side == Stage::right && !stage_.is_split())) continue;
    const View next = wanted_view().of_eye(two_eyes_ ? place : 0);
    if (boxes_shown_) {
      const std::vector<SightedBox> boxes = stage_.pane(side).boxes();
      if (place == 0)
        for (const SightedBox& box : boxes) ++box_counts_[static_cast<std::size_t>(box.state)];
      // The eye that the boxes were found from says which are the nearest
      const glm::dvec3 eye = stage_.pane(side).frozen() ? frozen_view_.eye : next.eye;
      wires_[place] = wires_of(boxes, stage_.grid(), eye, next);
    }
    if (!stage_.pane(side).frozen()) continue;
    const std::vector<WireEnd> camera = wires_of(frozen_view_, frozen_reach_, next);
    wires_[place].insert(wires_[place].end(), camera.begin(), camera.end());
  }
}

void Viewer::show_frame() {
  size_ = glm::max(window_.size(), 1);
  notice_motion();
  ask_for_reference();
  if (stage_.at_rest(wanted_view()) && frames_to_show_ == 0) return;
  const auto start = Clock::now();
  const std::uint64_t frames_before = stage_.frames();
  const bool was_moving = moving();
  draw_cloud();
  compare_frames();
  lay_wires();
  if (stage_.frame())
    display_.show(scene(size_.x), size_);
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
                                         .color = options_.color,
                                         .point_size = options_.point_size,
                                         .spacing = spacing_,
                                         .background = options_.background,
                                         .shaded = options_.shaded,
                                         .eye_dome = options_.eye_dome,
                                         .two_eyes = two_eyes_,
                                         .divider = shows_both() ? std::optional(divider_column()) : std::nullopt,
                                         .right_alone = shown_sides_ == Shown::right,
                                         .comparison = comparison_,
                                         .box_counts = boxes_shown_ ? std::optional(box_counts_) : std::nullopt,
                                         .under_cursor = under_cursor_,
                                         .recent = options_.recent,
                                         .tree_job = tree_job_,
                                         .built_tree = built_tree_,
                                         .can_build = can_build_,
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
  if (wishes.color) color_by(*wishes.color);
  if (wishes.point_size) set_point_size(*wishes.point_size);
  if (wishes.background) options_.background = *wishes.background;
  if (wishes.eye_dome) options_.eye_dome = *wishes.eye_dome;
  if (wishes.policy) set_policy(*wishes.policy);
  if (wishes.picture) want_screenshot(*wishes.picture);
  if (wishes.open) open(*wishes.open);
  if (wishes.dismiss_error) stage_.dismiss_error();
}

}  // namespace stipple
