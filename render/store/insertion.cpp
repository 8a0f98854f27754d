#include "render/store/insertion.h"

#include <bit>
#include <limits>

namespace stipple {
namespace {

// splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t next_random(std::uint64_t& state) {
  std::uint64_t x = state += 0x9E3779B97F4A7C15ull;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

// Below `bound`: a fraction of 64 bits times the bound, rounded down.
std::uint32_t random_below(std::uint32_t bound, std::uint64_t& state) {
  const std::uint64_t fraction = next_random(state);
  const std::uint64_t low = (fraction & 0xFFFFFFFFu) * bound >> 32;
  return static_cast<std::uint32_t>(((fraction >> 32) * bound + low) >> 32);
}

// Which new point stands in an old slot: a hash table with open addressing.
class Occupants {
 public:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  explicit Occupants(std::size_t most) : entries_(std::bit_ceil(2 * most + 1)) {}

  // Makes it `point`; returns what it was, kNone at first.
  std::uint32_t exchange(std::uint32_t slot, std::uint32_t point) {
    std::size_t at = slot * 0x9E3779B97F4A7C15ull >> 20 & (entries_.size() - 1);
    while (entries_[at].point != kNone && entries_[at].slot != slot) at = (at + 1) & (entries_.size() - 1);
    const std::uint32_t before = entries_[at].point;
    entries_[at] = {slot, point};
    return before;
  }

  template <class Visit>
  void for_each(const Visit& visit) const {
    for (const Entry& entry : entries_)
      if (entry.point != kNone) visit(entry.slot, entry.point);
  }

 private:
  struct Entry {
    std::uint32_t slot = 0;
    std::uint32_t point = kNone;
  };
  std::vector<Entry> entries_;
};

}  // namespace

Insertion plan_insertion(std::uint32_t taken, std::uint32_t points, std::uint64_t& state) {
  Insertion insertion;
  // Who stands in slot taken + i: a new point, or from `points` on a displaced one
  std::vector<std::uint32_t> end(points);
  Occupants occupants(points);
  for (std::uint32_t i = 0; i < points; ++i) {
    const std::uint32_t slot = random_below(taken + i + 1, state);
    end[i] = i;
    if (slot >= taken) {
      std::swap(end[i], end[slot - taken]);
    } else if (const std::uint32_t before = occupants.exchange(slot, i); before != Occupants::kNone) {
      end[i] = before;
    } else {
      end[i] = points + static_cast<std::uint32_t>(insertion.displaced.size());
      insertion.displaced.push_back(slot);
    }
  }
  insertion.slots.resize(points + insertion.displaced.size());
  occupants.for_each([&](std::uint32_t slot, std::uint32_t point) { insertion.slots[point] = slot; });
  for (std::uint32_t i = 0; i < points; ++i) insertion.slots[end[i]] = taken + i;
  return insertion;
}

}  // namespace stipple
