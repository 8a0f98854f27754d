#include "src/run/view_run.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

namespace stipple {

bool ended(const Until& until, const FrameState& state) {
  return state.converged || (until.frames && state.frame >= *until.frames) ||
         (until.milliseconds && state.milliseconds >= *until.milliseconds);
}

std::uint32_t largest_budget(const BudgetPolicy& policy) {
  return policy.frames_per_second ? BudgetController::Limits{}.most : policy.points;
}

TimedDrawing::TimedDrawing(ProgressiveRenderer& renderer, const BudgetPolicy& policy, const glm::ivec2& size,
                           std::size_t eyes)
    : renderer_(renderer), policy_(policy) {
  if (policy.frames_per_second && !renderer.steered())
    controller_.emplace(1000.0 / *policy.frames_per_second, BudgetController::kFirstBudget, BudgetController::Limits{});
  renderer.warm_up(size, eyes);
}

const FrameState& TimedDrawing::draw(const View& view, const std::function<void()>& before) {
  using Clock = std::chrono::steady_clock;
  ++state_.frame;
  const std::uint32_t budget = controller_ ? controller_->budget() : largest_budget(policy_);
  const auto start = Clock::now();
  if (before) before();
  renderer_.draw(view, budget);
  glFinish();
  const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
  const FrameReport report = renderer_.await_report();
  if (controller_) controller_->frame_done(report.points_filled, ms);

  state_.budget = report.budget;
  state_.milliseconds += ms;
  state_.points_drawn += report.points_filled;
  count_eyes(view.eyes());
  state_.converged = report.converged;
  return state_;
}

void TimedDrawing::count_eyes(std::size_t eyes) {
  state_.eyes.resize(eyes);
  state_.covered_pixels = 0;
  for (std::size_t i = 0; i < eyes; ++i) {
    EyeState& eye = state_.eyes[i];
    const std::uint64_t reprojected = renderer_.points_reprojected(i);
    eye.points_reprojected += reprojected;
    eye.covered_pixels = renderer_.covered_pixels(i);
    state_.points_reprojected += reprojected;
    state_.covered_pixels += eye.covered_pixels;
  }
}

FrameState draw_until(TimedDrawing& drawing, const View& view, const Until& until,
                      const std::function<void(const FrameState&)>& observe) {
  while (true) {
    const FrameState& state = drawing.draw(view);
    if (observe) observe(state);
    if (ended(until, state)) return state;
  }
}

FrameState run_view(ProgressiveRenderer& renderer, const View& view, const BudgetPolicy& policy, const Until& until,
                    const std::function<void(const FrameState&)>& observe) {
  TimedDrawing drawing(renderer, policy, view.size, view.eyes());
  return draw_until(drawing, view, until, observe);
}

}  // namespace stipple
