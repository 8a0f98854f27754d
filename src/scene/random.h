// Random numbers that are a function of seed and index, so that threads need no order among them.
#pragma once

#include <cstdint>

namespace stipple::scene {

// Finaliser of SplitMix64 (Steele, Lea, Flood 2014).
inline std::uint64_t mix64(std::uint64_t v) {
  v = (v ^ (v >> 30)) * 0xBF58476D1CE4E5B9ull;
  v = (v ^ (v >> 27)) * 0x94D049BB133111EBull;
  return v ^ (v >> 31);
}

// A SplitMix64 stream of its own for every (seed, index).
class PointRandom {
 public:
  PointRandom(std::uint64_t seed, std::uint64_t index) : state_(mix64(seed + mix64(index + kGolden))) {}

  std::uint64_t bits() { return mix64(state_ += kGolden); }
  // In [0, 1).
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  // In [0, count).
  std::uint32_t below(std::uint32_t count) { return static_cast<std::uint32_t>(((bits() >> 32) * count) >> 32); }
  // Mean 0, variance 1, within +-3.47: the sum of four 16-bit uniforms, which needs no logarithm.
  double normal() {
    const std::uint64_t b = bits();
    const std::uint64_t sum = (b & 0xFFFF) + ((b >> 16) & 0xFFFF) + ((b >> 32) & 0xFFFF) + (b >> 48);
    return (static_cast<double>(sum) - 131070.0) * (1.7320508075688772 / 65535.0);
  }

 private:
  static constexpr std::uint64_t kGolden = 0x9E3779B97F4A7C15ull;
  std::uint64_t state_;
};

}  // namespace stipple::scene
