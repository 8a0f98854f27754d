#include "render/measure/row_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stipple {
namespace {

// Pixels summed at once: as many as stay in registers.
constexpr int kBlock = 16;

// out[x] += sum of taps[k] source(k)[x]. The order of summation is that of the taps, whatever the width.
template <class Source>
void add_weighted(const Taps& taps, int width, const Source& source, float* out) {
  const int count = static_cast<int>(taps.size());
  int x = 0;
  for (; x + kBlock <= width; x += kBlock) {
    float sum[kBlock];
    std::copy_n(out + x, kBlock, sum);
    for (int k = 0; k < count; ++k) {
      const float weight = taps[static_cast<std::size_t>(k)];
      const float* in = source(k) + x;
      for (int i = 0; i < kBlock; ++i) sum[i] += weight * in[i];
    }
    std::copy_n(sum, kBlock, out + x);
  }
  for (; x < width; ++x)
    for (int k = 0; k < count; ++k) out[x] += taps[static_cast<std::size_t>(k)] * source(k)[x];
}

}  // namespace

Taps gaussian_taps(double sigma, int radius) {
  std::vector<double> weights;
  for (int x = -radius; x <= radius; ++x) weights.push_back(std::exp(-0.5 * x * x / (sigma * sigma)));
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  Taps taps;
  for (const double weight : weights) taps.push_back(static_cast<float>(weight / sum));
  return taps;
}

void Rows::extend(int i) {
  float* first = row(i);
  std::fill(first - margin_, first, first[0]);
  std::fill(first + width_, first + width_ + margin_, first[width_ - 1]);
}

void filter_along(const float* in, int width, const Taps& taps, float* out) {
  std::fill_n(out, width, 0.0f);
  const float* first = in - radius(taps);
  add_weighted(
      taps, width, [first](int k) { return first + k; }, out);
}

void add_filtered_across(const Rows& in, int center, const Taps& taps, float* out) {
  const int first = center - radius(taps);
  add_weighted(
      taps, in.width(), [&in, first](int k) { return in.row(first + k); }, out);
}

}  // namespace stipple
