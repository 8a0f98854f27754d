#include "src/check/canonical.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <type_traits>

#include "octree/build/stream/common_grid.h"

namespace stipple {
namespace {

// Below this part of a grid step, a difference is the rounding of doubles that large coordinates bring along.
constexpr double kNoRounding = 1e-5;

template <class T>
T nearest(double value) {
  if constexpr (std::is_floating_point_v<T>) {
    return static_cast<T>(value);
  } else {
    if (std::isnan(value)) return T{0};
    // The largest 64-bit numbers are no doubles, and would round up to what does not fit
    double max = static_cast<double>(std::numeric_limits<T>::max());
    if (std::numeric_limits<T>::digits > std::numeric_limits<double>::digits) max = std::nextafter(max, 0.0);
    return static_cast<T>(std::clamp(std::round(value), static_cast<double>(std::numeric_limits<T>::min()), max));
  }
}

template <class T>
void convert_values(const Column& from, Column& to) {
  const Attribute& attribute = to.attribute;
  const auto components = static_cast<std::size_t>(attribute.components);
  const std::span<T> values = to.as<T>();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double value = value_at(from, i / components, static_cast<int>(i % components));
    values[i] = nearest<T>((value - attribute.offset) / attribute.scale);
  }
}

void convert_column(const Column& from, Column& to) {
  if (from.attribute == to.attribute) {
    std::memcpy(to.bytes.data(), from.bytes.data(), to.bytes.size());
    return;
  }
  switch (to.attribute.type) {
    case ScalarType::u8:
      return convert_values<std::uint8_t>(from, to);
    case ScalarType::i8:
      return convert_values<std::int8_t>(from, to);
    case ScalarType::u16:
      return convert_values<std::uint16_t>(from, to);
    case ScalarType::i16:
      return convert_values<std::int16_t>(from, to);
    case ScalarType::u32:
      return convert_values<std::uint32_t>(from, to);
    case ScalarType::i32:
      return convert_values<std::int32_t>(from, to);
    case ScalarType::u64:
      return convert_values<std::uint64_t>(from, to);
    case ScalarType::i64:
      return convert_values<std::int64_t>(from, to);
    case ScalarType::f32:
      return convert_values<float>(from, to);
    case ScalarType::f64:
      return convert_values<double>(from, to);
  }
}

// As the builder does it: half a step between two places is rounded to the same one.
void convert_positions(const Conversion& conversion, const Buffer<glm::ivec3>& from, CanonicalBatch& result) {
  const GridTransform transform(conversion.from, conversion.to);
  if (transform.identity()) {
    result.positions = from;
    return;
  }
  result.positions.resize(from.size());
  const glm::dvec3& scale = conversion.to.scale;
  const double noise = kNoRounding * std::min({scale.x, scale.y, scale.z});
  for (std::size_t i = 0; i < from.size(); ++i) {
    result.positions[i] = transform(from[i]);
    if (const double rounding = transform.rounding(from[i]); rounding > noise)
      result.largest_rounding = std::max(result.largest_rounding, rounding);
  }
}

}  // namespace

Conversion conversion_of(const SourceInfo& source, const Grid& grid, const Schema& schema) {
  Conversion conversion{source.grid, grid, schema, {}, {}};
  for (const Attribute& attribute : schema) {
    const auto index = find_attribute(source.schema, attribute.name);
    if (!index || source.schema[*index].components != attribute.components) {
      conversion.place.emplace_back();
      continue;
    }
    conversion.place.emplace_back(conversion.asked.size());
    conversion.asked.push_back(*index);
  }
  return conversion;
}

void convert(const Conversion& conversion, const PointBatch& batch, CanonicalBatch& result) {
  result.first = batch.first;
  result.largest_rounding = 0.0;
  convert_positions(conversion, batch.positions, result);
  result.columns.resize(conversion.schema.size());
  for (std::size_t c = 0; c < result.columns.size(); ++c) {
    Column& column = result.columns[c];
    column.attribute = conversion.schema[c];
    column.resize(batch.positions.size());
    if (conversion.place[c])
      convert_column(batch.columns[*conversion.place[c]], column);
    else
      std::ranges::fill(column.bytes, std::byte{0});
  }
}

}  // namespace stipple
