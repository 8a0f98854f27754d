#include "octree/read/table/block_positions.h"

#include <bit>
#include <cmath>
#include <cstring>

namespace stipple {
namespace {

template <class T>
void copy_as_double(const Column& from, std::span<double> to) {
  const std::span<const T> values = from.as<T>();
  for (std::size_t i = 0; i < to.size(); ++i) to[i] = static_cast<double>(values[i]);
}

void copy_as_double(const Column& from, std::span<double> to) {
  switch (from.attribute.type) {
    case ScalarType::u8:
      return copy_as_double<std::uint8_t>(from, to);
    case ScalarType::i8:
      return copy_as_double<std::int8_t>(from, to);
    case ScalarType::u16:
      return copy_as_double<std::uint16_t>(from, to);
    case ScalarType::i16:
      return copy_as_double<std::int16_t>(from, to);
    case ScalarType::u32:
      return copy_as_double<std::uint32_t>(from, to);
    case ScalarType::i32:
      return copy_as_double<std::int32_t>(from, to);
    case ScalarType::u64:
      return copy_as_double<std::uint64_t>(from, to);
    case ScalarType::i64:
      return copy_as_double<std::int64_t>(from, to);
    case ScalarType::f32:
      return copy_as_double<float>(from, to);
    case ScalarType::f64:
      return copy_as_double<double>(from, to);
  }
}

bool is_coordinate(double value) {
  return std::abs(value) <= kLargestCoordinate;  // false for NaN
}

// Nearest whole number, for what fits into int32: added to 1.5 * 2^52, a double has it in its lowest bits.
std::int32_t nearest(double value) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(std::bit_cast<std::uint64_t>(value + 0x1.8p52)));
}

}  // namespace

void BlockPositions::load(const std::array<const Column*, 3>& columns, std::size_t rows) {
  rows_ = size_ = rows;
  kept_.clear();
  for (std::size_t a = 0; a < 3; ++a) {
    axes_[a].resize(rows);
    if (columns[a])
      copy_as_double(*columns[a], axes_[a]);
    else
      std::fill(axes_[a].begin(), axes_[a].end(), 0.0);
  }
  std::size_t good = 0;
  for (std::size_t i = 0; i < rows; ++i)
    good += std::size_t{is_coordinate(axes_[0][i])} & is_coordinate(axes_[1][i]) & is_coordinate(axes_[2][i]);
  if (good == rows) return;
  kept_.reserve(good);
  for (std::size_t i = 0; i < rows; ++i) {
    if (!is_coordinate(axes_[0][i]) || !is_coordinate(axes_[1][i]) || !is_coordinate(axes_[2][i])) continue;
    for (Buffer<double>& axis : axes_) axis[kept_.size()] = axis[i];
    kept_.push_back(static_cast<std::uint32_t>(i));
  }
  size_ = good;
}

void BlockPositions::put_on_grid(const Grid& grid, std::span<glm::ivec3> out) const {
  const glm::dvec3 offset = grid.offset;
  const glm::dvec3 steps = 1.0 / grid.scale;
  const double *x = axes_[0].data(), *y = axes_[1].data(), *z = axes_[2].data();
  for (std::size_t i = 0; i < size_; ++i)
    out[i] = {nearest((x[i] - offset.x) * steps.x), nearest((y[i] - offset.y) * steps.y),
              nearest((z[i] - offset.z) * steps.z)};
}

void BlockPositions::compact(Column& column) const {
  if (complete()) return;
  const std::size_t bytes = column.attribute.bytes();
  for (std::size_t i = 0; i < size_; ++i)
    std::memmove(column.bytes.data() + i * bytes, column.bytes.data() + kept_[i] * bytes, bytes);
  column.resize(size_);
}

}  // namespace stipple
