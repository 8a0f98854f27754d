#include "octree/build/sort.h"

#include <algorithm>
#include <array>
#include <utility>

namespace stipple {
namespace {

constexpr int kDigitBits = 9;  // three levels
constexpr std::size_t kBuckets = 1u << kDigitBits;
constexpr int kCodePasses = 7;              // 63 bits of code
constexpr int kPasses = kCodePasses + 4;    // 32 bits of rank; the last digit overlaps the one before
constexpr std::size_t kComparePoints = 64;  // below, comparing beats counting

std::size_t digit_of(const CodedPoint& point, int pass) {
  const std::uint64_t bits = pass < kCodePasses ? point.code >> (kDigitBits * (kCodePasses - 1 - pass))
                                                : point.rank >> std::max(0, 23 - kDigitBits * (pass - kCodePasses));
  return bits % kBuckets;
}

using Histogram = std::array<std::uint32_t, kBuckets>;

Histogram count_digits(std::span<const CodedPoint> points, int pass) {
  Histogram counts{};
  for (const CodedPoint& point : points) ++counts[digit_of(point, pass)];
  return counts;
}

// Moves the points into their buckets; turns counts into where each bucket ends.
void scatter(std::span<CodedPoint> points, std::span<CodedPoint> scratch, int pass, Histogram& buckets) {
  std::uint32_t first = 0;
  for (std::uint32_t& bucket : buckets) first += std::exchange(bucket, first);
  for (const CodedPoint& point : points) scratch[buckets[digit_of(point, pass)]++] = point;
  std::copy_n(scratch.begin(), points.size(), points.begin());
}

void sort_from(std::span<CodedPoint> points, std::span<CodedPoint> scratch, int pass) {
  Histogram buckets;
  do {
    if (points.size() <= kComparePoints || pass == kPasses) return std::sort(points.begin(), points.end());
    buckets = count_digits(points, pass);
  } while (buckets[digit_of(points[0], pass++)] == points.size());
  scatter(points, scratch, pass - 1, buckets);
  std::size_t first = 0;
  for (const std::size_t end : buckets) {
    if (end - first > 1) sort_from(points.subspan(first, end - first), scratch, pass);
    first = end;
  }
}

}  // namespace

void sort_points(std::span<CodedPoint> points, std::span<CodedPoint> scratch, int level) {
  sort_from(points, scratch, level / 3);
}

}  // namespace stipple
