// Peak signal-to-noise ratio.
#pragma once

#include <span>

#include "render/measure/image.h"

namespace stipple {

// Mean squared error over all pixels and the three channels, 0 to 255^2. Average these, never decibels. All cores;
// exact. Throws Error when the sizes differ.
double mean_squared_error(const Image& a, const Image& b);

// The same over the pixels where `ids` (those of a reference frame, one a pixel) has a point; 0 where none has.
// However much background a view shows, it does not flatter the picture.
double covered_mean_squared_error(const Image& a, const Image& b, std::span<const std::uint32_t> ids);

// 10 log10(255^2 / mse) in dB; infinite for mse 0.
double psnr_db(double mse);

}  // namespace stipple
