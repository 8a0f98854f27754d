#include "octree/read/table/table_color.h"

#include <cmath>
#include <cstring>

namespace stipple {
namespace {

constexpr double kFull = 65535.0;

double full_of(ColorDepth depth) {
  switch (depth) {
    case ColorDepth::unit:
      return 1.0;
    case ColorDepth::byte:
      return 255.0;
    case ColorDepth::word:
      return kFull;
  }
  return 1.0;
}

std::uint32_t packed_at(const Column& from, std::size_t i) {
  std::uint32_t value;
  std::memcpy(&value, from.bytes.data() + i * sizeof value, sizeof value);
  return value;
}

}  // namespace

void put_channel(const Column& from, int component, ColorDepth depth, int channel, std::span<std::uint16_t> rgb) {
  const std::size_t points = from.points();
  const auto place = static_cast<std::size_t>(channel);
  if (size_of(from.attribute.type) == 1) {
    const auto stride = static_cast<std::size_t>(from.attribute.components);
    for (std::size_t i = 0; i < points; ++i)
      rgb[3 * i + place] = static_cast<std::uint16_t>(
          std::to_integer<unsigned>(from.bytes[i * stride + static_cast<std::size_t>(component)]) * 257u);
    return;
  }
  const double factor = kFull / full_of(depth);
  for (std::size_t i = 0; i < points; ++i) {
    const double value = value_at(from, i, component) * factor;
    rgb[3 * i + place] = static_cast<std::uint16_t>(std::isnan(value) ? kFull : std::clamp(value + 0.5, 0.0, kFull));
  }
}

void put_packed(const Column& from, std::span<std::uint16_t> rgb) {
  for (std::size_t i = 0; i < from.points(); ++i) {
    const std::uint32_t value = packed_at(from, i);
    for (std::size_t c = 0; c < 3; ++c)
      rgb[3 * i + c] = static_cast<std::uint16_t>((value >> (16 - 8 * c) & 0xFFu) * 257u);
  }
}

void put_packed_alpha(const Column& from, std::span<std::uint8_t> alpha) {
  for (std::size_t i = 0; i < from.points(); ++i) alpha[i] = static_cast<std::uint8_t>(packed_at(from, i) >> 24);
}

}  // namespace stipple
