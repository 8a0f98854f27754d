// Colours of any depth as 16 bits a channel, as LAS and Potree have them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <span>

#include "octree/cloud/attribute.h"

namespace stipple {

// What full brightness is in the file. Bytes become value * 257, so that 255 becomes 65535 and nothing is lost.
enum class ColorDepth { unit, byte, word };

// Of fields whose type tells it: bytes, signed or not, and 16-bit numbers. Others hold 0 to 1, 0 to 255 or more, which
// their largest value tells.
inline bool tells_depth(ScalarType type) {
  return size_of(type) <= 2;
}
inline ColorDepth depth_of(ScalarType type) {
  return size_of(type) == 1 ? ColorDepth::byte : ColorDepth::word;
}
// `largest` of all channels of all points; a lone 1 in whole numbers is nearly black, not white.
inline ColorDepth depth_of(double largest, bool whole_numbers) {
  if (largest <= 1.0 && !whole_numbers) return ColorDepth::unit;
  return largest <= 255.0 ? ColorDepth::byte : ColorDepth::word;
}

// Writes channel `channel` of the points into `rgb`, three a point. What is no number becomes full brightness: no
// colour is white.
void put_channel(const Column& from, int component, ColorDepth depth, int channel, std::span<std::uint16_t> rgb);

// From 32-bit numbers with red in bits 16 to 23, green and blue below.
void put_packed(const Column& from, std::span<std::uint16_t> rgb);
// Their bits 24 to 31.
void put_packed_alpha(const Column& from, std::span<std::uint8_t> alpha);

}  // namespace stipple
