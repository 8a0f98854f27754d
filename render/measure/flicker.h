// What moves in a film that should not.
#pragma once

#include <cstdint>
#include <span>

#include "render/measure/image.h"

namespace stipple {

// A frame of a path: what was drawn, what should have been, and whose points the latter shows (a reference frame's
// ids).
struct FrameOnPath {
  const Image& test;
  const Image& reference;
  std::span<const std::uint32_t> reference_ids;
};

struct Flicker {
  // Over the still pixels and the three channels, the mean of |e_now - e_before| with e = test - reference: 0 to 510, 0
  // when the error stays as it was, however large. 0 where no pixel is still.
  double mean = 0.0;
  // Pixels where the reference shows the same point as before, or again none. The others have moved: there the error
  // changes because the picture does.
  std::uint64_t still_pixels = 0;
};

// Of two consecutive frames. All cores; the result does not depend on their number. Throws Error when the sizes differ.
Flicker flicker(const FrameOnPath& before, const FrameOnPath& now);

}  // namespace stipple
