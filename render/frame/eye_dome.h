// Eye-dome lighting: shape from depth alone, for points that have no normals.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "render/frame/feedback_target.h"
#include "render/gpu/program.h"

namespace stipple {

struct EyeDomeOptions {
  double strength = 0.4;  // 0: nothing is darkened
  double radius = 1.4;    // of the ring of neighbours, pixels

  bool operator==(const EyeDomeOptions&) const = default;
};

// A pass over a finished frame, which stays as it is. Source: Boucheny, "Visualisation scientifique interactive de
// grands volumes de donnees", 2009. A colour is multiplied by exp(-300 * strength * o), o being the mean of
// log2(distance here / distance there) over eight neighbours, those farther away counting 0; 300 as in Potree, for like
// numbers to look alike.
class EyeDome {
 public:
  // The frame's colours as PackedPoint::rgba, shaded (R32UI); 0 where no point is. Valid until the next call.
  const Texture2D& shade(const FeedbackTarget& frame, const EyeDomeOptions& options);

 private:
  std::optional<Program> from_image_;
  std::optional<Program> from_attachment_;
  Texture2D colors_;
};

// Such colours in main memory, row 0 at the top. Waits for the GPU.
std::vector<std::uint32_t> read_colors(const Texture2D& colors);

}  // namespace stipple
