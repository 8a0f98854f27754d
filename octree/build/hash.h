// Repeatable randomness: the same seed gives the same numbers on every machine and with any number of threads.
#pragma once

#include <cstdint>

namespace stipple {

// A bijection of 32 bits that leaves no visible pattern. Source: C. Wellons, "Prospecting for Hash Functions", 2018.
constexpr std::uint32_t mix32(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

// A bijection of 64 bits. Source: Steele, Lea, Flood, "Fast Splittable Pseudorandom Number Generators", 2014, finaliser
// variant 13 of D. Stafford.
constexpr std::uint64_t mix64(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
  return x ^ (x >> 31);
}

// SplitMix64 (same source): a short independent stream for each pair of seed and stream number.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream) : state_(mix64(seed + kStep) ^ mix64(stream)) {}

  // Uniform in [0, bound) up to a bias of bound / 2^32 (Lemire 2019 without the rejection); bound >= 1.
  std::uint32_t below(std::uint32_t bound) {
    state_ += kStep;
    return static_cast<std::uint32_t>(((mix64(state_) >> 32) * bound) >> 32);
  }

 private:
  static constexpr std::uint64_t kStep = 0x9e3779b97f4a7c15u;
  std::uint64_t state_;
};

}  // namespace stipple
