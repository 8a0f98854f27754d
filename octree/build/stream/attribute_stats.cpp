#include "octree/build/stream/attribute_stats.h"

#include <algorithm>
#include <limits>
#include <span>

namespace stipple {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

// Of every `stride`-th value from the first on.
template <class T>
void extend(std::span<const T> values, std::size_t stride, double& min, double& max) {
  T low = std::numeric_limits<T>::max(), high = std::numeric_limits<T>::lowest();
  const auto scan = [&](std::size_t step) {
    for (std::size_t i = 0; i < values.size(); i += step) {
      low = values[i] < low ? values[i] : low;
      high = values[i] > high ? values[i] : high;
    }
  };
  if (stride == 1)
    scan(1);  // a constant step is vectorised
  else
    scan(stride);
  if (low > high) return;
  min = std::min(min, static_cast<double>(low));
  max = std::max(max, static_cast<double>(high));
}

template <class Function>
void with_type(ScalarType type, const Function& function) {
  switch (type) {
    case ScalarType::u8:
      return function(std::uint8_t{});
    case ScalarType::i8:
      return function(std::int8_t{});
    case ScalarType::u16:
      return function(std::uint16_t{});
    case ScalarType::i16:
      return function(std::int16_t{});
    case ScalarType::u32:
      return function(std::uint32_t{});
    case ScalarType::i32:
      return function(std::int32_t{});
    case ScalarType::u64:
      return function(std::uint64_t{});
    case ScalarType::i64:
      return function(std::int64_t{});
    case ScalarType::f32:
      return function(float{});
    case ScalarType::f64:
      return function(double{});
  }
}

bool has_histogram(const Attribute& attribute) {
  return attribute.type == ScalarType::u8 && attribute.components == 1;
}

// Four tables by turns: neighbours often have the same value, and a counter cannot be raised twice at once.
void count_bytes(std::span<const std::uint8_t> values, std::span<std::uint64_t> histogram) {
  std::array<std::array<std::uint32_t, 256>, 4> counts{};
  std::size_t i = 0;
  for (; i + 4 <= values.size(); i += 4)
    for (std::size_t table = 0; table < 4; ++table) ++counts[table][values[i + table]];
  for (; i < values.size(); ++i) ++counts[0][values[i]];
  for (std::size_t value = 0; value < 256; ++value)
    for (const auto& table : counts) histogram[value] += table[value];
}

}  // namespace

AttributeStats::AttributeStats(const Schema& schema) : schema_(schema) {
  for (const Attribute& attribute : schema) {
    const auto components = static_cast<std::size_t>(attribute.components);
    extremes_.push_back(
        {std::vector<double>(components, kInfinity), std::vector<double>(components, -kInfinity), Histogram{}});
  }
}

void AttributeStats::add(std::size_t index, const Column& column) {
  const Attribute& attribute = schema_[index];
  Extremes& extremes = extremes_[index];
  if (column.points() == 0) return;
  const auto components = static_cast<std::size_t>(attribute.components);
  with_type(attribute.type, [&]<class T>(T) {
    for (std::size_t c = 0; c < components; ++c)
      extend(column.as<T>().subspan(c), components, extremes.min[c], extremes.max[c]);
  });
  if (has_histogram(attribute)) count_bytes(column.as<std::uint8_t>(), extremes.histogram);
}

void AttributeStats::add(const AttributeStats& other) {
  for (std::size_t a = 0; a < extremes_.size(); ++a) {
    for (std::size_t c = 0; c < extremes_[a].min.size(); ++c) {
      extremes_[a].min[c] = std::min(extremes_[a].min[c], other.extremes_[a].min[c]);
      extremes_[a].max[c] = std::max(extremes_[a].max[c], other.extremes_[a].max[c]);
    }
    for (std::size_t v = 0; v < 256; ++v) extremes_[a].histogram[v] += other.extremes_[a].histogram[v];
  }
}

std::vector<potree2::AttributeRange> AttributeStats::ranges() const {
  std::vector<potree2::AttributeRange> ranges;
  for (std::size_t a = 0; a < schema_.size(); ++a) {
    potree2::AttributeRange& range = ranges.emplace_back();
    for (std::size_t c = 0; c < extremes_[a].min.size(); ++c) {
      const bool none = extremes_[a].min[c] > extremes_[a].max[c];
      range.min.push_back(none ? 0.0 : extremes_[a].min[c] * schema_[a].scale + schema_[a].offset);
      range.max.push_back(none ? 0.0 : extremes_[a].max[c] * schema_[a].scale + schema_[a].offset);
    }
    if (has_histogram(schema_[a])) range.histogram.assign(extremes_[a].histogram.begin(), extremes_[a].histogram.end());
  }
  return ranges;
}

}  // namespace stipple
