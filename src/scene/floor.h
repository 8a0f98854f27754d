// Rounding down without a call: below SSE 4.1 the compiler leaves std::floor to libm, which costs more than the noise
// that it is for.
#pragma once

#include <cstdint>

namespace stipple::scene {

// For |x| < 2^63.
inline std::int64_t floor_of(double x) {
  const auto cut = static_cast<std::int64_t>(x);
  return cut - (static_cast<double>(cut) > x ? 1 : 0);
}

// x - floor(x)
inline double fraction_of(double x) {
  return x - static_cast<double>(floor_of(x));
}

}  // namespace stipple::scene
