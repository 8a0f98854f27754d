#include "render/method/unstructured.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <vector>

#include "octree/core/error.h"

namespace stipple {
namespace {

// Where upload_shuffled() puts the point with each id.
std::vector<std::uint32_t> slots_of(const PointSet& points, std::uint64_t seed) {
  const auto count = static_cast<std::uint32_t>(points.size());
  std::vector<std::uint32_t> slots(count);
  for (std::uint32_t i = 0; i < count; ++i) {
    if (points.id(i) >= count)
      throw Error(
          "mode unstructured carries indices of points that are numbered from 0 on, and those of an octree on disk are "
          "not. Use --carry vertex.");
    slots[points.id(i)] = i;
  }
  const ShuffledSlots shuffled(count, seed);
  tbb::parallel_for(std::uint32_t{0}, count, [&](std::uint32_t id) { slots[id] = shuffled(slots[id]); });
  return slots;
}

}  // namespace

Unstructured::Unstructured(const PointSet& points, std::uint64_t seed, Carry carry)
    : cloud_(upload_shuffled(points, seed)), left_(points.size()) {
  if (carry == Carry::indices && points.size() > 0) indices_.emplace(cloud_, slots_of(points, seed));
}

std::vector<DrawItem> Unstructured::warm_up(const View&, const FeedbackTarget& frame) {
  std::vector<DrawItem> items;
  if (indices_) {
    indices_->prepare(frame);
    indices_->append_items(items);
  }
  return items;
}

Selection Unstructured::select(std::uint32_t budget) {
  const std::size_t count = std::min<std::size_t>(budget, left_);
  const std::size_t before_end = std::min(count, cloud_.size() - cursor_);
  Selection selection;
  cloud_.append_items(cursor_, before_end, selection.items);
  cloud_.append_items(0, count - before_end, selection.items);
  if (indices_) indices_->append_items(selection.items);
  selection.points = count;
  if (cloud_.size() > 0) cursor_ = (cursor_ + count) % cloud_.size();
  left_ -= count;
  return selection;
}

}  // namespace stipple
