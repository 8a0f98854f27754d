#include "octree/cloud/grid_fit.h"

#include <cmath>
#include <cstdint>
#include <limits>

namespace stipple {

double fitting_scale(double scale, double extent) {
  static constexpr double kFactors[] = {1.0, 2.0, 5.0};
  for (double decade = 1.0;; decade *= 10.0)
    for (const double factor : kFactors)
      if (extent / (scale * decade * factor) <= kGridSteps) return scale * decade * factor;
}

double fitting_offset(double offset, double scale, const AxisRange& range) {
  const double low = std::floor((range.min - offset) / scale);
  const double high = std::ceil((range.max - offset) / scale);
  if (low >= std::numeric_limits<std::int32_t>::min() && high <= std::numeric_limits<std::int32_t>::max())
    return offset;
  return offset + scale * std::round(low + (high - low) * 0.5);
}

}  // namespace stipple
