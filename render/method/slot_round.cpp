#include "render/method/slot_round.h"

#include <algorithm>

namespace stipple {

void SlotRound::restart(std::size_t slots) {
  slots_ = slots;
  left_ = slots;
  if (steered_) steered_->restart(slots);
}

Selection SlotRound::next(const GpuCloud& cloud, std::uint32_t budget) {
  if (steered_) return steered_->next(cloud, budget);
  const std::size_t count = std::min<std::size_t>(budget, left_);
  const std::size_t before_end = std::min(count, slots_ - cursor_);
  Selection selection;
  cloud.append_items(cursor_, before_end, selection.items);
  cloud.append_items(0, count - before_end, selection.items);
  selection.points = count;
  if (slots_ > 0) cursor_ = (cursor_ + count) % slots_;
  left_ -= count;
  return selection;
}

}  // namespace stipple
