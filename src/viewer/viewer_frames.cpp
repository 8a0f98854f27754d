// Frames: when there is one to draw, how much of it, and what is shown of it.
#include <epoxy/gl.h>

#include <algorithm>
#include <utility>

#include "octree/core/error.h"
#include "src/viewer/viewer.h"

namespace stipple {
namespace {

constexpr std::size_t kFramesPlotted = 120;
// A camera that has not moved for so long stands still.
constexpr double kStillSeconds = 0.15;
// Points a frame of a still view, at least: nobody waits for its next frame, all wait for its last.
constexpr std::uint32_t kLeastStillBudget = 200'000;
// Of the time a frame has, what is left to points at least, whatever display and panels take.
constexpr double kLeastForCloud = 0.25;

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

// What a frame may take until the cloud is drawn. What comes after it took so long the last time.
double Viewer::cloud_target_ms() const {
  const double target = 1000.0 / *options_.policy.frames_per_second;
  return std::max(target - after_cloud_ms_, kLeastForCloud * target);
}

std::uint32_t Viewer::first_budget(const View& view) {
  if (!parts_) return options_.policy.points;
  const auto pixels = static_cast<double>(view.size.x) * view.size.y * static_cast<double>(view.eyes());
  parts_->scale_pixels(pixels / std::exchange(steered_pixels_, pixels));
  parts_->aim_at(cloud_target_ms());
  const std::uint32_t first = parts_->first(!stage_.adds_to_frames());
  return moving() ? first : std::max(first, kLeastStillBudget);
}

void Viewer::set_policy(const BudgetPolicy& policy) {
  options_.policy = policy;
  if (!policy.frames_per_second)
    parts_.reset();
  else if (!parts_)
    parts_.emplace(cloud_target_ms(), BudgetController::kFirstBudget, BudgetController::Limits{});
}

void Viewer::draw_cloud(const Stopwatch& frame) {
  const View fine = wanted_view();
  const bool of_window = fine == view();
  const bool coarse = moving() && parts_ && resolution_.divisor() > 1 && of_window;
  const View next = coarse ? view_of(glm::max(size_ / resolution_.divisor(), 1)) : fine;
  if (stage_.at_rest(next)) return;
  if (std::exchange(drawn_view_, next) != next) comparison_.begin_view(window_.seconds());
  try {
    const std::uint64_t drawn = stage_.draw(next, first_budget(next));
    draw_rest(next, drawn, frame);
  } catch (const Error& e) {
    // A picture for which there is no room is no reason to end
    if (of_window || options_.exit_after_screenshot) throw;
    screenshot_.clear();
    options_.screenshot_size.reset();
    note_ = e.what();
    stage_.begin_again();
  }
  hover_stale_ = true;
  if (!stage_.at_rest(fine)) return;
  frames_to_show_ = kFramesAfterEvent;
  if (stage_.unread().parts > 0) note_ = "the picture is not complete: the panel says why";
}

// Adds to the frame, as far as there is time.
void Viewer::draw_rest(const View& view, std::uint64_t drawn, const Stopwatch& frame) {
  if (!parts_ || stage_.pane().mode() == Mode::brute_force) return;
  while (true) {
    glFinish();
    const std::uint32_t more = parts_->next(drawn, frame.milliseconds());
    if (more == 0 || stage_.at_rest(view)) return;
    drawn = stage_.draw_more(more);
  }
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
  const Stopwatch watch;
  const std::uint64_t frames_before = stage_.frames();
  const bool was_moving = moving();
  draw_cloud(watch);
  glFinish();
  const double cloud_ms = watch.milliseconds();
  compare_frames();
  lay_wires();
  if (stage_.frame())
    display_.show(scene(size_.x), size_);
  else
    display_.clear(options_.background, size_);
  show_panels();
  glFinish();
  const double ms = watch.milliseconds();
  after_cloud_ms_ = ms - cloud_ms;
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
  if (parts_ && was_moving) resolution_.frame_done(parts_->fixed_ms(), cloud_target_ms());
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
