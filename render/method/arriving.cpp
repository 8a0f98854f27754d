#include "render/method/arriving.h"

namespace stipple {

Arriving::Arriving(std::size_t total, ArrivalOrder order, std::uint64_t seed, Carry carry,
                   const std::optional<GpuSteering>& steering)
    : cloud_(total, order, seed, carry == Carry::indices), round_(steering, cloud_.cloud().chunks().size()) {
  if (carry == Carry::indices && total > 0) indices_.emplace(cloud_.cloud(), cloud_.slot_of());
}

void Arriving::add(std::span<const PackedPoint> points, std::uint32_t first_id) {
  // Putting points in their places is a part of the frame
  if (steered()) steered()->begin_frame();
  cloud_.add(points, first_id);
  round_.restart(cloud_.slots());
}

}  // namespace stipple
