#include "render/method/unstructured.h"

#include <tbb/parallel_for.h>

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

Unstructured::Unstructured(const PointSet& points, std::uint64_t seed, Carry carry,
                           const std::optional<GpuSteering>& steering)
    : cloud_(upload_shuffled(points, seed)), round_(steering, cloud_.chunks().size()) {
  round_.restart(cloud_.size());
  if (carry == Carry::indices && points.size() > 0) indices_.emplace(cloud_, slots_of(points, seed));
}

}  // namespace stipple
