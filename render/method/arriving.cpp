#include "render/method/arriving.h"

namespace stipple {

Arriving::Arriving(std::size_t total, ArrivalOrder order, std::uint64_t seed, Carry carry)
    : cloud_(total, order, seed, carry == Carry::indices) {
  if (carry == Carry::indices && total > 0) indices_.emplace(cloud_.cloud(), cloud_.slot_of());
}

void Arriving::add(std::span<const PackedPoint> points, std::uint32_t first_id) {
  cloud_.add(points, first_id);
  round_.left = cloud_.slots();
}

void Arriving::forget() {
  last_ = nullptr;
  if (indices_) indices_->forget();
}

std::vector<DrawItem> Arriving::warm_up(const View&, const FeedbackTarget& frame) {
  std::vector<DrawItem> items;
  if (!indices_) return items;
  indices_->prepare(frame);
  indices_->append_items(items);
  return items;
}

// The slots that a frame showed are looked up now: since it was drawn, points may have been displaced.
Selection Arriving::select(std::uint32_t budget) {
  Selection selection = round_.next(cloud_.cloud(), cloud_.slots(), budget);
  if (indices_ && last_) {
    indices_->prepare(*last_);
    indices_->append_items(selection.items);
  }
  return selection;
}

}  // namespace stipple
