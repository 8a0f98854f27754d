// Peak signal-to-noise ratio.
#pragma once

#include "render/measure/image.h"

namespace stipple {

// Mean squared error over all pixels and the three channels, 0 to 255^2. Average these, never decibels.
// Throws Error when the sizes differ.
double mean_squared_error(const Image& a, const Image& b);

// 10 log10(255^2 / mse) in dB; infinite for mse 0.
double psnr_db(double mse);

}  // namespace stipple
