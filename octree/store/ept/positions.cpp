#include <fmt/format.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "octree/core/error.h"
#include "octree/store/ept/format.h"

namespace stipple::ept {
namespace {

constexpr std::int32_t kLowest = std::numeric_limits<std::int32_t>::min();
constexpr std::int32_t kHighest = std::numeric_limits<std::int32_t>::max();

// What one axis is put on.
struct Target {
  int axis;
  double scale;
  double offset;

  Error beyond(std::size_t point) const {
    return Error(
        fmt::format("{} of its point {} is too far from the tree's cube for a grid of {}", "xyz"[axis], point, scale));
  }
};

template <class T>
void decode_integers(const std::byte* from, std::size_t row, const Axis& axis, const Target& target,
                     Buffer<glm::ivec3>& to) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    T stored;
    std::memcpy(&stored, from + i * row, sizeof stored);
    if constexpr (sizeof(T) < 8) {
      const std::int64_t value = static_cast<std::int64_t>(stored) - axis.base;
      if (value < kLowest || value > kHighest) throw target.beyond(i);
      to[i][target.axis] = static_cast<std::int32_t>(value);
    } else {
      if constexpr (std::is_unsigned_v<T>)
        if (stored > static_cast<T>(std::numeric_limits<std::int64_t>::max())) throw target.beyond(i);
      // The base is below 10^18: a difference that wraps around does not end up within int32
      const auto value =
          static_cast<std::int64_t>(static_cast<std::uint64_t>(stored) - static_cast<std::uint64_t>(axis.base));
      if (value < kLowest || value > kHighest) throw target.beyond(i);
      to[i][target.axis] = static_cast<std::int32_t>(value);
    }
  }
}

template <class T>
void decode_reals(const std::byte* from, std::size_t row, const Axis& axis, const Target& target,
                  Buffer<glm::ivec3>& to) {
  for (std::size_t i = 0; i < to.size(); ++i) {
    T stored;
    std::memcpy(&stored, from + i * row, sizeof stored);
    const double world = axis.offset + axis.scale * static_cast<double>(stored);
    const double value = std::round((world - target.offset) / target.scale);
    if (!(value >= kLowest && value <= kHighest)) throw target.beyond(i);
    to[i][target.axis] = static_cast<std::int32_t>(value);
  }
}

void decode_axis(const std::byte* rows, std::size_t row, const Axis& axis, const Target& target,
                 Buffer<glm::ivec3>& to) {
  const std::byte* from = rows + axis.place;
  switch (axis.type) {
    case ScalarType::u8:
      return decode_integers<std::uint8_t>(from, row, axis, target, to);
    case ScalarType::i8:
      return decode_integers<std::int8_t>(from, row, axis, target, to);
    case ScalarType::u16:
      return decode_integers<std::uint16_t>(from, row, axis, target, to);
    case ScalarType::i16:
      return decode_integers<std::int16_t>(from, row, axis, target, to);
    case ScalarType::u32:
      return decode_integers<std::uint32_t>(from, row, axis, target, to);
    case ScalarType::i32:
      return decode_integers<std::int32_t>(from, row, axis, target, to);
    case ScalarType::u64:
      return decode_integers<std::uint64_t>(from, row, axis, target, to);
    case ScalarType::i64:
      return decode_integers<std::int64_t>(from, row, axis, target, to);
    case ScalarType::f32:
      return decode_reals<float>(from, row, axis, target, to);
    case ScalarType::f64:
      return decode_reals<double>(from, row, axis, target, to);
  }
}

}  // namespace

void decode_positions(std::span<const std::byte> rows, const Metadata& metadata, Buffer<glm::ivec3>& positions) {
  positions.resize(rows.size() / metadata.rows.bytes);
  if (positions.empty()) return;
  for (int axis = 0; axis < 3; ++axis)
    decode_axis(rows.data(), metadata.rows.bytes, metadata.axes[static_cast<std::size_t>(axis)],
                {axis, metadata.grid.scale[axis], metadata.grid.offset[axis]}, positions);
}

}  // namespace stipple::ept
