// FLIP: how different two pictures look when flipped between.
#pragma once

#include "render/measure/image.h"

namespace stipple {

// Mean LDR-FLIP of Andersson, Nilsson, Akenine-Moeller, Oskarsson, Astrom, Fairchild 2020, "FLIP: A Difference
// Evaluator for Alternating Images": 0 (no visible difference) to 1, seen at 67 pixels per degree (the paper's: a 0.7 m
// wide monitor of 3840 pixels at 0.7 m). The pictures are taken as sRGB with white D65. Beyond the border, pixels are
// those on it. Symmetric. All cores; the result does not depend on their number. Needs a few rows of memory a core. 0
// for pictures without a pixel. Throws Error when the sizes differ.
double flip(const Image& test, const Image& reference);

}  // namespace stipple
