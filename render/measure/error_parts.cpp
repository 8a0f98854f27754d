#include "render/measure/error_parts.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <array>

#include "render/measure/same_size.h"

namespace stipple {
namespace {

enum Part { kRounding, kSelection, kCarry, kParts };
// Integers: whatever the order of summing, the sum is the same.
using Squares = std::array<std::uint64_t, kParts>;

Part part_of(std::uint32_t id, std::uint32_t brute_force_id, const ShownPoints& shown) {
  if (id == brute_force_id) return kRounding;
  return brute_force_id == kNoPoint || shown.contains(brute_force_id) ? kCarry : kSelection;
}

}  // namespace

void ShownPoints::add(std::span<const std::uint32_t> ids) {
  for (const std::uint32_t id : ids) {
    if (id == kNoPoint) continue;
    if (id / 64 >= bits_.size()) bits_.resize(id / 64 + 1);
    bits_[id / 64] |= std::uint64_t{1} << (id % 64);
  }
}

ErrorParts error_parts(const Image& test, std::span<const std::uint32_t> ids, const Image& reference,
                       std::span<const std::uint32_t> brute_force_ids, const ShownPoints& shown) {
  require_same_size(test.size, reference.size);
  const std::size_t pixels = test.rgb.size() / 3;
  if (ids.size() != pixels || brute_force_ids.size() != pixels)
    throw Error(fmt::format("a picture of {}x{} pixels came with {} and {} ids of points", test.size.x, test.size.y,
                            ids.size(), brute_force_ids.size()));
  const Squares sum = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, pixels, 1 << 14), Squares{},
      [&](const auto& range, Squares so_far) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          std::uint64_t& squares = so_far[part_of(ids[i], brute_force_ids[i], shown)];
          for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
            const int difference = test.rgb[c] - reference.rgb[c];
            squares += static_cast<std::uint64_t>(difference * difference);
          }
        }
        return so_far;
      },
      [](Squares a, const Squares& b) {
        for (std::size_t i = 0; i < a.size(); ++i) a[i] += b[i];
        return a;
      });
  if (pixels == 0) return {};
  const auto mean = [&](Part part) { return static_cast<double>(sum[part]) / (3.0 * static_cast<double>(pixels)); };
  return {mean(kRounding), mean(kSelection), mean(kCarry)};
}

}  // namespace stipple
