// What the colours of a cloud mean.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "render/store/dataset.h"

namespace stipple {

// The colours (as PackedPoint::rgba) of `steps` values evenly spaced from the map's low end to its high one; of
// classes, those of classes 0, 1, ... None for colours that mean themselves.
std::vector<std::uint32_t> legend_colors(const ColorMap& map, int steps);

// LAS classes 0 to 18, by the ASPRS specification 1.4; empty for others.
std::string_view class_name(int value);

// World units for height, else the attribute's own.
double legend_value(const Dataset& dataset, double mapped);

// The ends of a map as text, with as many digits as tell them apart.
std::array<std::string, 2> range_text(double low, double high);

// In the panel: what the colours mean, and what can be chosen about them, which changes `choice`.
void show_legend(const Dataset& dataset, ColorChoice& choice);

}  // namespace stipple
