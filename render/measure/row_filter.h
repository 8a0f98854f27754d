// Filters of one direction on rows of floats: what windows that are products of two are made of.
#pragma once

#include <cstddef>
#include <vector>

namespace stipple {

// Weights of an odd number of neighbours, the middle one for the pixel itself.
using Taps = std::vector<float>;

// Rows of a result that one task computes: so many that the rows neighbours both have to filter are the smaller part,
// so few that those of a task stay in the cache.
inline constexpr int kBandRows = 48;

inline int radius(const Taps& taps) {
  return static_cast<int>(taps.size() / 2);
}

// exp(-x^2 / (2 sigma^2)) for x from -radius to radius, with sum 1. `sigma` in pixels, above 0.
Taps gaussian_taps(double sigma, int radius);

// Rows of one width, each with a margin on both sides so that filters can read beyond the border.
class Rows {
 public:
  Rows(int width, int count, int margin)
      : width_(width),
        margin_(margin),
        stride_(static_cast<std::size_t>(width) + 2 * static_cast<std::size_t>(margin)),
        values_(stride_ * static_cast<std::size_t>(count)) {}

  int width() const { return width_; }
  float* row(int i) { return values_.data() + offset(i); }
  const float* row(int i) const { return values_.data() + offset(i); }
  // Fills the margins of a row with its first and its last value.
  void extend(int i);

 private:
  std::size_t offset(int i) const { return stride_ * static_cast<std::size_t>(i) + static_cast<std::size_t>(margin_); }

  int width_;
  int margin_;
  std::size_t stride_;
  std::vector<float> values_;
};

// out[x] = sum of taps[k] in[x + k - radius], for x from 0 to width - 1: `in` must be readable from -radius to
// width - 1 + radius. `out` must not overlap `in`.
void filter_along(const float* in, int width, const Taps& taps, float* out);

// out[x] += sum of taps[k] row(center + k - radius)[x]: those rows must exist.
void add_filtered_across(const Rows& in, int center, const Taps& taps, float* out);

}  // namespace stipple
