// One method drawing, frame by frame, with a clock.
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "render/frame/frame_data.h"
#include "render/frame/frame_parts.h"
#include "render/method/progressive_renderer.h"

namespace stipple {

// When to stop.
struct Until {
  bool converged = true;
  std::optional<std::uint64_t> frames;
  std::optional<double> milliseconds;
};

// Points a frame: a fixed number, or what a frame-rate target allows, drawn in parts (FrameParts). Where the GPU steers
// to a target by itself, it is asked (MethodOptions::steering).
struct BudgetPolicy {
  std::uint32_t points = 1'000'000;
  std::optional<double> frames_per_second;
};

// Of one of the eyes.
struct EyeState {
  std::uint64_t points_reprojected = 0;  // carried points drawn again
  std::uint64_t covered_pixels = 0;
};

// The state after a frame. Sums run from the first frame; time is that of drawing alone, each frame awaited.
struct FrameState {
  std::uint64_t frame = 0;  // 1 for the first
  double milliseconds = 0.0;
  std::uint64_t points_drawn = 0;        // by fill, once where there are two eyes
  std::uint64_t points_reprojected = 0;  // carried points drawn again, by all eyes
  std::uint64_t covered_pixels = 0;      // of all eyes
  std::vector<EyeState> eyes{};
  std::uint32_t budget = 0;  // of this frame
  bool converged = false;
  std::optional<std::uint64_t> points_loaded{};  // of a cloud that is being read

  // P = V (R + S) of T16: the points drawn in all views together.
  std::uint64_t points_in_views() const { return eyes.size() * points_drawn + points_reprojected; }
};

// A renderer that draws whatever view comes next, each frame timed.
class TimedDrawing {
 public:
  // `renderer` must outlive this. It is warmed up for frames of `size` first, one for each eye, outside the clock.
  TimedDrawing(ProgressiveRenderer& renderer, const BudgetPolicy& policy, const glm::ivec2& size, std::size_t eyes = 1);

  // `before`, where there is one, goes before the frame and is timed with it.
  const FrameState& draw(const View& view, const std::function<void()>& before = {});
  // Time that passed otherwise.
  void pass(double milliseconds) { state_.milliseconds += milliseconds; }
  // The next frame is the first: sums begin anew. What is drawn stays, and so does what a frame-rate target has learnt.
  void start_again() { state_ = {}; }

 private:
  void count_eyes(std::size_t eyes);

  ProgressiveRenderer& renderer_;
  BudgetPolicy policy_;
  std::optional<FrameParts> parts_;
  FrameState state_;
};

// Whether the frame with this state was the last.
bool ended(const Until& until, const FrameState& state);

// Draws until `until`; at least one frame. `observe` is called after each frame, outside the clock, and may read the
// renderer.
FrameState draw_until(TimedDrawing& drawing, const View& view, const Until& until,
                      const std::function<void(const FrameState&)>& observe = {});

// The same from nothing.
FrameState run_view(ProgressiveRenderer& renderer, const View& view, const BudgetPolicy& policy, const Until& until,
                    const std::function<void(const FrameState&)>& observe = {});

// The largest number of points a frame may be asked for under this policy.
std::uint32_t largest_budget(const BudgetPolicy& policy);

}  // namespace stipple
