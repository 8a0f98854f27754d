// S19: Schuetz, Mandlburger, Otepka, Wimmer 2019, "Progressive Real-Time Rendering of One Billion Points Without
// Hierarchical Acceleration Structures": the adaptive fill, whose budget is measured and spent on the GPU.
#pragma once

#include <cstdint>

#include "render/frame/budget.h"
#include "render/gpu/late_copy.h"
#include "render/gpu/program.h"
#include "render/gpu/time_stamp.h"
#include "render/method/method.h"
#include "render/store/gpu_cloud.h"

namespace stipple {

// Layout of State in shaders/steer.glsl.
struct SteeringState {
  // Those of BudgetController and FrameCost
  double target_ms = 0.0;
  double fixed = 0.0;
  double per_point_ms = 0.0;
  double fixed2 = 0.0;
  double fixed_per_point = 0.0;
  double per_point2 = 0.0;
  std::uint32_t least = 0;
  std::uint32_t most = 0;
  std::uint32_t budget = 0;  // of the last frame
  std::int32_t surprise = 0;

  std::uint32_t cursor = 0;
  std::uint32_t left = 0;
  std::uint32_t round = 0;
  std::uint32_t drawn = 0;
  std::uint32_t total = 0;
  std::uint32_t unused = 0;
};

// Before its first frame.
SteeringState initial_state(const GpuSteering& steering);

// A SlotRound's stretches; how long each is, the GPU finds by its own clock, the same way as BudgetController. Nothing
// is read back to draw.
class SteeredRound {
 public:
  // Of a cloud of so many chunks. Throws Error when memory is refused.
  SteeredRound(const GpuSteering& steering, std::size_t chunks);

  // As SlotRound's.
  void restart(std::size_t slots);
  // For the clock: the frame begins, unless it has; next() has it begin, too.
  void begin_frame();
  // The next stretch of the cloud, of at most `most` slots. Selection::points is 0: the CPU does not know.
  Selection next(const GpuCloud& cloud, std::uint32_t most);
  // The frame of that stretch is drawn.
  void end_frame();
  // It was none that tells how long frames take.
  void drop_frame() { begun_ = false; }

  // Takes what the GPU has told of past frames by now.
  void hear();
  // Waits until it has told all.
  void await();
  // It has told that all slots were drawn since the last restart.
  bool finished() const { return slots_ == 0 || (told_.round == round_ && told_.left == 0); }
  // Points of frames that it has told of since the last call.
  std::uint64_t take_points();
  // Of the last frame that it has told of: what its time allows.
  std::uint32_t budget() const { return told_.budget; }

 private:
  void learn(const SteeringState& state);

  std::uint32_t slots_ = 0;
  std::uint32_t round_ = 0;
  bool begun_ = false;    // a frame has begun and not ended
  bool stamped_ = false;  // the last frame's time stamps are taken
  bool timed_ = false;    // and on their way to `stamps_`
  Program program_;
  GpuBuffer state_;
  GpuBuffer stamps_;
  GpuBuffer commands_;
  TimeStamp began_;
  TimeStamp ended_;
  LateCopy copy_;
  SteeringState told_;
  std::uint64_t points_ = 0;  // told of, and not taken
};

}  // namespace stipple
