// What a share of many measurements stays at or below.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace stipple {

// The smallest of the values that at least `percent` (above 0, at most 100) of them do not exceed: always one that was
// measured (nearest rank). 0 when there are none.
template <class T>
T percentile(std::vector<T> values, double percent) {
  if (values.empty()) return T{};
  const double rank = std::ceil(percent * static_cast<double>(values.size()) / 100.0);
  const auto nth = values.begin() + static_cast<std::ptrdiff_t>(std::max(rank, 1.0)) - 1;
  std::ranges::nth_element(values, nth);
  return *nth;
}

}  // namespace stipple
