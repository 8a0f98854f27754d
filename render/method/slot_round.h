// The fill of mode unstructured.
#pragma once

#include <optional>

#include "render/method/method.h"
#include "render/method/steered_round.h"
#include "render/store/gpu_cloud.h"

namespace stipple {

// Stretches of the slots of a shuffled cloud, one after the other, around its end to its beginning.
class SlotRound {
 public:
  // Of a cloud of so many chunks. With `steering` the GPU decides how long a stretch is, and knows what is left.
  SlotRound(const std::optional<GpuSteering>& steering, std::size_t chunks) {
    if (steering) steered_.emplace(*steering, chunks);
  }

  // The first `slots` slots of the cloud, at least as many as before, are all to be drawn, from the end of the last
  // stretch on.
  void restart(std::size_t slots);
  // The next stretch, of at most `budget` slots.
  Selection next(const GpuCloud& cloud, std::uint32_t budget);
  bool finished() const { return steered_ ? steered_->finished() : left_ == 0; }
  // Null where the CPU has the budget.
  SteeredRound* steered() { return steered_ ? &*steered_ : nullptr; }

 private:
  std::size_t slots_ = 0;
  std::size_t cursor_ = 0;  // first slot of the next stretch
  std::size_t left_ = 0;    // slots not drawn yet
  std::optional<SteeredRound> steered_;
};

}  // namespace stipple
