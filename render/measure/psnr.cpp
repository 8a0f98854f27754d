#include "render/measure/psnr.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cmath>
#include <limits>

#include "render/measure/same_size.h"

namespace stipple {
namespace {

// Integers, so that the sum is exact and does not depend on the order: even 2^47 bytes that all differ by 255 fit.
struct SquaredErrors {
  std::uint64_t squares = 0;
  std::uint64_t pixels = 0;
};

// Over the pixels for which `counts(i)`.
template <class Counts>
double mean_squared_error_where(const Image& a, const Image& b, const Counts& counts) {
  require_same_size(a.size, b.size);
  const SquaredErrors sum = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, a.rgb.size() / 3, 1 << 14), SquaredErrors{},
      [&](const auto& pixels, SquaredErrors so_far) {
        for (std::size_t i = pixels.begin(); i < pixels.end(); ++i) {
          if (!counts(i)) continue;
          ++so_far.pixels;
          for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const int difference = a.rgb[c] - b.rgb[c];
            so_far.squares += static_cast<std::uint64_t>(difference * difference);
          }
        }
        return so_far;
      },
      [](const SquaredErrors& left, const SquaredErrors& right) {
        return SquaredErrors{left.squares + right.squares, left.pixels + right.pixels};
      });
  if (sum.pixels == 0) return 0.0;
  return static_cast<double>(sum.squares) / (3.0 * static_cast<double>(sum.pixels));
}

}  // namespace

double mean_squared_error(const Image& a, const Image& b) {
  return mean_squared_error_where(a, b, [](std::size_t) { return true; });
}

double covered_mean_squared_error(const Image& a, const Image& b, std::span<const std::uint32_t> ids) {
  require_same_size(a.size, b.size);
  if (ids.size() != a.rgb.size() / 3)
    throw Error(fmt::format("a picture of {}x{} pixels came with {} ids of points", a.size.x, a.size.y, ids.size()));
  return mean_squared_error_where(a, b, [ids](std::size_t i) { return ids[i] != kNoPoint; });
}

double psnr_db(double mse) {
  if (mse == 0.0) return std::numeric_limits<double>::infinity();
  return 10.0 * std::log10(255.0 * 255.0 / mse);
}

}  // namespace stipple
