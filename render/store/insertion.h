// Where new points go in a shuffled array that grows. Source: S18 (Schuetz, Wimmer 2018, "Progressive Real-Time
// Rendering of Unprocessed Point Clouds").
#pragma once

#include <cstdint>
#include <vector>

namespace stipple {

// New points swap into random slots; the points displaced go to the end.
struct Insertion {
  std::vector<std::uint32_t> slots;      // of the new points, in order; then of the displaced ones
  std::vector<std::uint32_t> displaced;  // the slots that those leave

  std::size_t points() const { return slots.size() - displaced.size(); }
};

// Of `points` new points into slots [0, taken + points), of which [0, taken) are taken. As if they came one by one,
// each changing places with one of those there or with none, all alike (the shuffle of Fisher and Yates, inside out):
// where the array was a uniform shuffle it is one again. `state` is that of the random numbers. taken + points < 2^32.
Insertion plan_insertion(std::uint32_t taken, std::uint32_t points, std::uint64_t& state);

}  // namespace stipple
