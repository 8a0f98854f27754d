#include "render/measure/ssim.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <vector>

#include "render/measure/row_filter.h"
#include "render/measure/same_size.h"

namespace stipple {
namespace {

constexpr int kRadius = 5;
constexpr double kSigma = 1.5;
constexpr float kC1 = 0.01f * 255.0f * 0.01f * 255.0f;
constexpr float kC2 = 0.03f * 255.0f * 0.03f * 255.0f;

// With s = a + b and d = a - b, all that SSIM asks for are the moments of s and d by themselves; and where the pictures
// are the same, d is exactly zero and SSIM exactly one. Variances do not change when s is centred, and float keeps more
// of them.
constexpr float kCentre = 255.0f;

enum Moment { kSum, kDifference, kSumSquared, kDifferenceSquared, kMoments };
using MomentRow = std::array<std::vector<float>, kMoments>;

void fill_moments(const std::uint8_t* a, const std::uint8_t* b, MomentRow& row) {
  for (std::size_t x = 0; x < row[kSum].size(); ++x) {
    const float s = static_cast<float>(a[3 * x] + b[3 * x]) - kCentre;
    const float d = static_cast<float>(a[3 * x] - b[3 * x]);
    row[kSum][x] = s;
    row[kDifference][x] = d;
    row[kSumSquared][x] = s * s;
    row[kDifferenceSquared][x] = d * d;
  }
}

double sum_of_similarity(const MomentRow& mean) {
  double total = 0.0;
  for (std::size_t x = 0; x < mean[kSum].size(); ++x) {
    const float s = mean[kSum][x] + kCentre;
    const float d = mean[kDifference][x];
    const float s_variance = std::max(mean[kSumSquared][x] - mean[kSum][x] * mean[kSum][x], 0.0f);
    const float d_variance = std::max(mean[kDifferenceSquared][x] - d * d, 0.0f);
    // 2 mu_a mu_b = (s^2 - d^2) / 2, mu_a^2 + mu_b^2 = (s^2 + d^2) / 2; variances alike
    const float numerator = (s * s - d * d + 2.0f * kC1) * (s_variance - d_variance + 2.0f * kC2);
    const float denominator = (s * s + d * d + 2.0f * kC1) * (s_variance + d_variance + 2.0f * kC2);
    total += static_cast<double>(numerator / denominator);
  }
  return total;
}

// The sum of SSIM over the windows centred on rows first to last - 1 of one channel.
double sum_of_band(const Image& a, const Image& b, int channel, int first, int last, const Taps& taps) {
  const int width = a.size.x;
  const int inner = width - 2 * kRadius;
  const int count = last - first + 2 * kRadius;
  std::vector<Rows> along(kMoments, Rows(inner, count, 0));
  MomentRow row;
  for (std::vector<float>& values : row) values.resize(static_cast<std::size_t>(width));
  for (int i = 0; i < count; ++i) {
    const std::size_t start = static_cast<std::size_t>(first - kRadius + i) * static_cast<std::size_t>(width) * 3 +
                              static_cast<std::size_t>(channel);
    fill_moments(&a.rgb[start], &b.rgb[start], row);
    for (std::size_t m = 0; m < kMoments; ++m) filter_along(row[m].data() + kRadius, inner, taps, along[m].row(i));
  }
  double total = 0.0;
  for (int i = 0; i < last - first; ++i) {
    for (std::size_t m = 0; m < kMoments; ++m) {
      row[m].assign(static_cast<std::size_t>(inner), 0.0f);
      add_filtered_across(along[m], i + kRadius, taps, row[m].data());
    }
    total += sum_of_similarity(row);
  }
  return total;
}

}  // namespace

std::optional<double> ssim(const Image& a, const Image& b) {
  require_same_size(a.size, b.size);
  const glm::ivec2 inner = a.size - 2 * kRadius;
  if (inner.x < 1 || inner.y < 1) return std::nullopt;
  const Taps taps = gaussian_taps(kSigma, kRadius);
  const int bands = (inner.y + kBandRows - 1) / kBandRows;
  // Summed in a fixed order, so that the result does not depend on who was first
  std::vector<double> sums(static_cast<std::size_t>(bands) * 3);
  tbb::parallel_for(std::size_t{0}, sums.size(), [&](std::size_t task) {
    const int first = kRadius + static_cast<int>(task / 3) * kBandRows;
    const int last = std::min(first + kBandRows, a.size.y - kRadius);
    sums[task] = sum_of_band(a, b, static_cast<int>(task % 3), first, last, taps);
  });
  return std::accumulate(sums.begin(), sums.end(), 0.0) / (3.0 * inner.x * inner.y);
}

}  // namespace stipple
