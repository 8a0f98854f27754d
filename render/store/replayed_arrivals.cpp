#include "render/store/replayed_arrivals.h"

#include <algorithm>

#include "octree/core/error.h"

namespace stipple {

ReplayedArrivals::ReplayedArrivals(const Dataset& dataset) : dataset_(dataset) {
  const PointSet& set = dataset.points;
  if (!dataset.in_memory() || dataset.tree)
    throw Error(
        "an octree on disk is not drawn while it is loaded: modes hierarchical and hybrid draw it at once. Give the "
        "points as a file");
  if (set.ids.empty()) return;
  place_of_.resize(set.size());
  for (std::size_t i = 0; i < set.size(); ++i) place_of_[set.ids[i]] = static_cast<std::uint32_t>(i);
}

PointArrivals::Batch ReplayedArrivals::take(std::size_t most) {
  const std::uint32_t first = next_;
  const std::size_t count = std::min(most, total() - first);
  next_ += static_cast<std::uint32_t>(count);
  if (place_of_.empty()) return {first, std::span(dataset_.points.points).subspan(first, count)};
  taken_.resize(count);
  for (std::size_t i = 0; i < count; ++i) taken_[i] = dataset_.points.points[place_of_[first + i]];
  return {first, taken_};
}

std::shared_ptr<const Dataset> ReplayedArrivals::whole() {
  if (next_ < total()) return nullptr;
  return {std::shared_ptr<const Dataset>(), &dataset_};
}

}  // namespace stipple
