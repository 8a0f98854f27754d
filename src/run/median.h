// The middle of a few measurements.
#pragma once

#include <algorithm>
#include <vector>

namespace stipple {

// Of an even number of values, the mean of the two in the middle. `values` must not be empty.
inline double median(std::vector<double> values) {
  std::ranges::sort(values);
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace stipple
