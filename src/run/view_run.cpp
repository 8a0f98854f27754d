#include "src/run/view_run.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <chrono>

namespace stipple {
namespace {

// Where a frame-rate target starts from.
constexpr std::uint32_t kFirstBudget = 100'000;

bool over(const Until& until, const FrameState& state) {
  return state.converged || (until.frames && state.frame >= *until.frames) ||
         (until.milliseconds && state.milliseconds >= *until.milliseconds);
}

}  // namespace

std::uint32_t largest_budget(const BudgetPolicy& policy) {
  return policy.frames_per_second ? BudgetController::Limits{}.most : policy.points;
}

FrameState run_view(ProgressiveRenderer& renderer, const View& view, const BudgetPolicy& policy, const Until& until,
                    const std::function<void(const FrameState&)>& observe) {
  using Clock = std::chrono::steady_clock;
  std::optional<BudgetController> controller;
  if (policy.frames_per_second)
    controller.emplace(1000.0 / *policy.frames_per_second, kFirstBudget, BudgetController::Limits{});

  renderer.warm_up(view.size);
  FrameState state;
  do {
    ++state.frame;
    state.budget = controller ? controller->budget() : policy.points;
    const auto start = Clock::now();
    const FrameReport report = renderer.draw(view, state.budget);
    glFinish();
    const double ms = std::chrono::duration<double, std::milli>(Clock::now() - start).count();
    if (controller) controller->frame_done(report.points_filled, ms);

    state.milliseconds += ms;
    state.points_drawn += report.points_filled;
    state.points_reprojected += renderer.points_reprojected();
    state.covered_pixels = renderer.covered_pixels();
    state.converged = report.converged;
    if (observe) observe(state);
  } while (!over(until, state));
  return state;
}

}  // namespace stipple
