#include "render/measure/row_filter.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace stipple {
namespace {

// out[x] += sum of taps[k] source(k)[x]. Four taps a pass: fewer would load and store `out` more often, and compilers
// see by themselves that each pixel is on its own. The order of summation does not depend on the width.
template <class Source>
void add_weighted(const Taps& taps, int width, const Source& source, float* out) {
  std::size_t k = 0;
  for (; k + 4 <= taps.size(); k += 4) {
    const float* in[] = {source(k), source(k + 1), source(k + 2), source(k + 3)};
    const float weights[] = {taps[k], taps[k + 1], taps[k + 2], taps[k + 3]};
    for (int x = 0; x < width; ++x)
      out[x] += (weights[0] * in[0][x] + weights[1] * in[1][x]) + (weights[2] * in[2][x] + weights[3] * in[3][x]);
  }
  for (; k < taps.size(); ++k) {
    const float* in = source(k);
    const float weight = taps[k];
    for (int x = 0; x < width; ++x) out[x] += weight * in[x];
  }
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
      taps, width, [first](std::size_t k) { return first + k; }, out);
}

void add_filtered_across(const Rows& in, int center, const Taps& taps, float* out) {
  const int first = center - radius(taps);
  add_weighted(
      taps, in.width(), [&in, first](std::size_t k) { return in.row(first + static_cast<int>(k)); }, out);
}

}  // namespace stipple
