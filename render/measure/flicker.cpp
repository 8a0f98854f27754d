#include "render/measure/flicker.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <cstdlib>

#include "render/measure/same_size.h"

namespace stipple {
namespace {

// Integers: whatever the order of summing, the sum is the same.
struct ErrorChange {
  std::uint64_t change = 0;
  std::uint64_t still = 0;
};

ErrorChange change_of(const FrameOnPath& before, const FrameOnPath& now, const tbb::blocked_range<std::size_t>& pixels,
                      ErrorChange sum) {
  for (std::size_t i = pixels.begin(); i < pixels.end(); ++i) {
    if (before.reference_ids[i] != now.reference_ids[i]) continue;
    ++sum.still;
    for (std::size_t c = 3 * i; c < 3 * i + 3; ++c) {
      const int error_before = before.test.rgb[c] - before.reference.rgb[c];
      const int error_now = now.test.rgb[c] - now.reference.rgb[c];
      sum.change += static_cast<std::uint64_t>(std::abs(error_now - error_before));
    }
  }
  return sum;
}

void require_whole(const FrameOnPath& frame) {
  require_same_size(frame.test.size, frame.reference.size);
  if (frame.reference_ids.size() * 3 != frame.reference.rgb.size())
    throw Error(fmt::format("a picture of {}x{} pixels came with {} ids of points", frame.reference.size.x,
                            frame.reference.size.y, frame.reference_ids.size()));
}

}  // namespace

Flicker flicker(const FrameOnPath& before, const FrameOnPath& now) {
  require_whole(before);
  require_whole(now);
  require_same_size(before.test.size, now.test.size);
  const ErrorChange sum = tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, now.reference_ids.size(), 1 << 14), ErrorChange{},
      [&](const auto& pixels, const ErrorChange& so_far) { return change_of(before, now, pixels, so_far); },
      [](const ErrorChange& a, const ErrorChange& b) {
        return ErrorChange{a.change + b.change, a.still + b.still};
      });
  if (sum.still == 0) return {};
  return {static_cast<double>(sum.change) / (3.0 * static_cast<double>(sum.still)), sum.still};
}

}  // namespace stipple
