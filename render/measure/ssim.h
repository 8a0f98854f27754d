// Structural similarity.
#pragma once

#include <optional>

#include "render/measure/image.h"

namespace stipple {

// Mean SSIM of Wang, Bovik, Sheikh, Simoncelli 2004, "Image Quality Assessment: From Error Visibility to Structural
// Similarity", equation 13: -1 to 1, and 1 for identical pictures. Symmetric. Gaussian window of 11x11 pixels and
// deviation 1.5, K1 = 0.01, K2 = 0.03, L = 255; moments are those of the window's weights (no sample correction). Of
// the 8-bit values as they are, for red, green and blue apart; the mean is over the three channels and over the pixels
// whose window lies wholly in the picture. This is structural_similarity(a, b, gaussian_weights=True, sigma=1.5,
// use_sample_covariance=False, data_range=255, channel_axis=-1) of scikit-image.
// Nothing when a side is shorter than the window. All cores; the result does not depend on their number. Throws Error
// when the sizes differ.
std::optional<double> ssim(const Image& a, const Image& b);

}  // namespace stipple
