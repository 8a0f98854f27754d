#include "src/run/view_run.h"

#include <epoxy/gl.h>

#include <algorithm>

#include "octree/core/stopwatch.h"

namespace stipple {

bool ended(const Until& until, const FrameState& state) {
  return (state.converged && until.converged) || (until.frames && state.frame >= *until.frames) ||
         (until.milliseconds && state.milliseconds >= *until.milliseconds);
}

std::uint32_t largest_budget(const BudgetPolicy& policy) {
  return policy.frames_per_second ? BudgetController::Limits{}.most : policy.points;
}

TimedDrawing::TimedDrawing(ProgressiveRenderer& renderer, const BudgetPolicy& policy, const glm::ivec2& size,
                           std::size_t eyes)
    : renderer_(renderer), policy_(policy) {
  if (policy.frames_per_second && !renderer.steered())
    parts_.emplace(1000.0 / *policy.frames_per_second, BudgetController::kFirstBudget, BudgetController::Limits{});
  renderer.warm_up(size, eyes);
}

const FrameState& TimedDrawing::draw(const View& view, const std::function<void()>& before) {
  ++state_.frame;
  state_.budget = 0;
  double ms = 0.0;
  const Stopwatch watch;
  const auto await_part = [&] {
    glFinish();
    ms = watch.milliseconds();
    const FrameReport report = renderer_.await_report();
    state_.budget += report.budget;
    state_.points_drawn += report.points_filled;
    state_.converged = report.converged;
    return report.points_filled;
  };
  if (before) before();
  renderer_.draw(view, parts_ ? parts_->first(!renderer_.adds_to_frames()) : largest_budget(policy_));
  std::uint64_t points = await_part();
  while (parts_) {
    const std::uint32_t more = parts_->next(points, ms);
    if (more == 0 || state_.converged) break;
    renderer_.draw_more(more);
    points = await_part();
  }
  state_.milliseconds += ms;
  count_eyes(view.eyes());
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
