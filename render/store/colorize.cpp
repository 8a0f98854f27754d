#include "render/store/colorize.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

#include "octree/core/error.h"

namespace stipple {
namespace {

using Range = tbb::blocked_range<std::size_t>;

constexpr std::uint32_t pack(std::uint32_t r, std::uint32_t g, std::uint32_t b) {
  return r | g << 8 | b << 16 | 0xFF000000u;
}

// Dark blue to yellow, even steps of lightness.
constexpr std::array<glm::vec3, 6> kRamp{
    {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};

// Created, unclassified, ground, low, medium and high vegetation, building, low noise, key point, water, rail, road,
// overlap, wire guard, conductor, tower, connector, bridge, high noise.
constexpr std::array<std::uint32_t, 19> kClassColors{
    pack(160, 160, 160), pack(190, 190, 190), pack(150, 111, 74),  pack(158, 202, 110), pack(98, 168, 77),
    pack(44, 122, 58),   pack(214, 96, 77),   pack(120, 60, 120),  pack(230, 200, 80),  pack(66, 133, 200),
    pack(110, 90, 90),   pack(90, 96, 105),   pack(200, 180, 220), pack(240, 170, 60),  pack(250, 210, 60),
    pack(130, 80, 160),  pack(220, 130, 190), pack(200, 150, 120), pack(180, 40, 160)};

std::uint32_t ramp_color(double t) {
  const double at = t * static_cast<double>(kRamp.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), kRamp.size() - 2);
  const glm::vec3 c = glm::mix(kRamp[low], kRamp[low + 1], static_cast<float>(at - static_cast<double>(low))) + 0.5f;
  return pack(static_cast<std::uint32_t>(c.x), static_cast<std::uint32_t>(c.y), static_cast<std::uint32_t>(c.z));
}

std::uint32_t grey_color(double t) {
  const auto v = static_cast<std::uint32_t>(t * 255.0 + 0.5);
  return pack(v, v, v);
}

// Classes may come as any type; what is none has the colour of class 0.
std::uint32_t class_color(double value) {
  const bool known = value >= 0.0 && value < 1e9;
  return kClassColors[(known ? static_cast<std::size_t>(value) : 0) % kClassColors.size()];
}

bool has_rgb16(const Column& column) {
  const Attribute& attribute = column.attribute;
  return attribute.name == "rgb" && attribute.type == ScalarType::u16 && attribute.components == 3;
}

// Whether all channels of all points are below 256.
bool fits_8_bits(std::span<const std::uint16_t> values) {
  return tbb::parallel_reduce(
             Range(0, values.size(), 65536), std::uint16_t{0},
             [&](const Range& range, std::uint16_t most) {
               for (std::size_t i = range.begin(); i < range.end(); ++i) most = std::max(most, values[i]);
               return most;
             },
             [](std::uint16_t a, std::uint16_t b) { return std::max(a, b); }) <= 255;
}

// The 1st and 99th percentile of value(i), from at most a million of them; rounded outwards, so that two values differ.
template <class Value>
std::pair<double, double> robust_range(std::size_t count, const Value& value) {
  const std::size_t step = std::max<std::size_t>(1, count / 1'000'000);
  std::vector<double> sample;
  for (std::size_t i = 0; i < count; i += step)
    if (const double v = value(i); std::isfinite(v)) sample.push_back(v);
  if (sample.empty()) return {0.0, 1.0};
  const auto at = [&](double part) {
    const double place = part * static_cast<double>(sample.size() - 1);
    const auto nth = sample.begin() + static_cast<std::ptrdiff_t>(part < 0.5 ? std::floor(place) : std::ceil(place));
    std::nth_element(sample.begin(), nth, sample.end());
    return *nth;
  };
  const double low = at(0.01);
  return {low, at(0.99)};
}

// out[i].rgba = rgba(i)
template <class Rgba>
void color_points(std::span<PackedPoint> out, const Rgba& rgba) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i].rgba = rgba(i);
}

// Colours by where value(i) lies between the map's ends.
template <class Value, class Rgba>
void color_by_value(const ColorMap& map, std::span<PackedPoint> out, const Value& value, const Rgba& rgba) {
  const double stretch = map.high > map.low ? 1.0 / (map.high - map.low) : 0.0;
  color_points(out, [&](std::size_t i) {
    const double t = (value(i) - map.low) * stretch;
    return rgba(t > 0.0 ? std::min(t, 1.0) : 0.0);  // not a number becomes 0
  });
}

}  // namespace

std::string choose_color(const Schema& schema, const std::string& name) {
  if (name.empty()) {
    for (const char* wanted : {"rgb", "intensity"})
      if (find_attribute(schema, wanted)) return wanted;
    return "height";
  }
  if (name == "height" || find_attribute(schema, name)) return name;
  std::vector<std::string> names{"height"};
  for (const Attribute& attribute : schema) names.push_back(attribute.name);
  throw UsageError(
      fmt::format("--color {}: the points have no such attribute; there are: {}", name, fmt::join(names, ", ")));
}

std::vector<std::string> attributes_for_color(const std::string& color) {
  return color == "height" ? std::vector<std::string>{} : std::vector{color};
}

ColorMap map_colors(const Cloud& cloud, const std::string& color) {
  ColorMap map{.attribute = color};
  if (color == "height") {
    std::tie(map.low, map.high) =
        robust_range(cloud.size(), [&](std::size_t i) { return static_cast<double>(cloud.positions[i].z); });
    return map;
  }
  const Column* column = cloud.find(color);
  if (!column) throw Error(fmt::format("{}: attribute {} was not read", cloud.info.path, color));
  if (has_rgb16(*column)) {
    map.kind = fits_8_bits(column->as<std::uint16_t>()) ? ColorMap::Kind::rgb8 : ColorMap::Kind::rgb16;
  } else if (color == "classification") {
    map.kind = ColorMap::Kind::classes;
  } else {
    map.kind = color == "intensity" ? ColorMap::Kind::grey : ColorMap::Kind::ramp;
    std::tie(map.low, map.high) = robust_range(cloud.size(), [&](std::size_t i) { return value_at(*column, i); });
  }
  return map;
}

ColorMap map_colors(const TreeStore& tree, const Cloud& root, const std::string& color) {
  ColorMap map = map_colors(root, color);
  if (map.kind != ColorMap::Kind::rgb8 && map.kind != ColorMap::Kind::rgb16) return map;
  const TreeInfo& info = tree.info();
  const std::vector<double>& most = info.ranges[*find_attribute(info.source.schema, color)].max;
  if (!most.empty() && std::ranges::all_of(most, [](double v) { return std::isfinite(v); }))
    map.kind = std::ranges::max(most) > 255.0 ? ColorMap::Kind::rgb16 : ColorMap::Kind::rgb8;
  return map;
}

void pack_points(const ColorMap& map, std::span<const glm::ivec3> positions, const Column* column, std::size_t first,
                 std::span<PackedPoint> out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i].position = positions[first + i];
  const auto value = [&](std::size_t i) {
    return column ? value_at(*column, first + i) : static_cast<double>(positions[first + i].z);
  };
  switch (map.kind) {
    case ColorMap::Kind::rgb8:
    case ColorMap::Kind::rgb16: {
      const auto values = column->as<std::uint16_t>().subspan(3 * first);
      const int shift = map.kind == ColorMap::Kind::rgb16 ? 8 : 0;
      color_points(out, [&](std::size_t i) {
        return pack(values[3 * i] >> shift & 0xFFu, values[3 * i + 1] >> shift & 0xFFu,
                    values[3 * i + 2] >> shift & 0xFFu);
      });
      break;
    }
    case ColorMap::Kind::classes:
      color_points(out, [&](std::size_t i) { return class_color(value(i)); });
      break;
    case ColorMap::Kind::grey:
      color_by_value(map, out, value, grey_color);
      break;
    case ColorMap::Kind::ramp:
      color_by_value(map, out, value, ramp_color);
      break;
  }
}

PointSet make_point_set(const Cloud& cloud, const ColorMap& map) {
  PointSet set;
  set.grid = cloud.info.grid;
  set.bounds = cloud.bounds;
  set.points.resize(cloud.size());
  const Column* column = cloud.find(map.attribute);
  tbb::parallel_for(Range(0, cloud.size(), 65536), [&](const Range& range) {
    pack_points(map, cloud.positions, column, range.begin(),
                std::span(set.points).subspan(range.begin(), range.size()));
  });
  return set;
}

PointSet make_point_set(const Cloud& cloud, const std::string& color) {
  return make_point_set(cloud, map_colors(cloud, color));
}

}  // namespace stipple
