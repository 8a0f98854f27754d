// The curves as a picture.
#pragma once

#include <span>
#include <string>

#include "src/study/curve.h"

namespace stipple {

// An SVG document: a row for each dataset, view and regime, on the left PSNR against points drawn, on the right, where
// there was a clock, against milliseconds, a line for each mode and repeat. Frames identical to the reference stand on
// the upper edge, those that equal brute force are ringed.
std::string plot_svg(std::span<const Curve> curves);

}  // namespace stipple
