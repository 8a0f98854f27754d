// Where the error of a picture comes from.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "render/measure/image.h"

namespace stipple {

// Points by their ids: those that some frames have shown.
class ShownPoints {
 public:
  // Ids of a frame; kNoPoint is none.
  void add(std::span<const std::uint32_t> ids);
  bool contains(std::uint32_t id) const { return id / 64 < bits_.size() && (bits_[id / 64] >> (id % 64) & 1) != 0; }
  void clear() { bits_.assign(bits_.size(), 0); }

 private:
  std::vector<std::uint64_t> bits_;
};

// Parts of the mean squared error against the reference; their sum is that error. Each pixel belongs to one:
//
//   rounding   shows the point that brute force shows, drawn by the same rasterizer: what differs from the reference
//              is a matter of float against double
//   carry      brute force's point was shown before, and was lost on the way here; or there is a picture of nothing
//   selection  brute force's point has not been shown yet
struct ErrorParts {
  double rounding = 0.0;
  double selection = 0.0;
  double carry = 0.0;
};

// `test` shows the points `ids`, brute force of the same view and rasterizer `brute_force_ids`; `shown` are the points
// that earlier frames of the same run have shown. All cores; the result does not depend on their number. Throws Error
// when the sizes differ.
ErrorParts error_parts(const Image& test, std::span<const std::uint32_t> ids, const Image& reference,
                       std::span<const std::uint32_t> brute_force_ids, const ShownPoints& shown);

}  // namespace stipple
