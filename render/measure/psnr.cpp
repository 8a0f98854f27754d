#include "render/measure/psnr.h"

#include <fmt/format.h>

#include <cmath>
#include <limits>

#include "octree/core/error.h"

namespace stipple {

double mean_squared_error(const Image& a, const Image& b) {
  if (a.size != b.size)
    throw Error(fmt::format("cannot compare a picture of {}x{} pixels with one of {}x{}", a.size.x, a.size.y, b.size.x,
                            b.size.y));
  if (a.rgb.empty()) return 0.0;
  // Integers, so that the sum is exact: even 2^47 bytes that all differ by 255 fit
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < a.rgb.size(); ++i) {
    const int difference = a.rgb[i] - b.rgb[i];
    sum += static_cast<std::uint64_t>(difference * difference);
  }
  return static_cast<double>(sum) / static_cast<double>(a.rgb.size());
}

double psnr_db(double mse) {
  if (mse == 0.0) return std::numeric_limits<double>::infinity();
  return 10.0 * std::log10(255.0 * 255.0 / mse);
}

}  // namespace stipple
