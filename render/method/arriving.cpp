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

}  // namespace stipple
