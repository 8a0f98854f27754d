#include "render/method/unstructured.h"

#include <algorithm>

namespace stipple {

Unstructured::Unstructured(const PointSet& points, std::uint64_t seed)
    : cloud_(upload_shuffled(points, seed)), left_(points.size()) {}

Selection Unstructured::select(std::uint32_t budget) {
  const std::size_t count = std::min<std::size_t>(budget, left_);
  const std::size_t before_end = std::min(count, cloud_.size() - cursor_);
  Selection selection;
  cloud_.append_items(cursor_, before_end, selection.items);
  cloud_.append_items(0, count - before_end, selection.items);
  selection.points = count;
  if (cloud_.size() > 0) cursor_ = (cursor_ + count) % cloud_.size();
  left_ -= count;
  return selection;
}

}  // namespace stipple
