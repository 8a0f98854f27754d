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

// Evenly spaced stops of the published tables, between which colours are mixed: viridis, magma and plasma (Smith, van
// der Walt 2015), cividis (Nunez, Anderton, Renslow 2018).
constexpr std::array<glm::vec3, 6> kViridis{
    {{68, 1, 84}, {65, 68, 135}, {42, 120, 142}, {34, 168, 132}, {122, 209, 81}, {253, 231, 37}}};
constexpr std::array<glm::vec3, 6> kMagma{
    {{0, 0, 4}, {59, 15, 112}, {140, 41, 129}, {222, 73, 104}, {254, 159, 109}, {252, 253, 191}}};
constexpr std::array<glm::vec3, 6> kPlasma{
    {{13, 8, 135}, {106, 0, 168}, {177, 42, 144}, {225, 100, 98}, {252, 166, 54}, {240, 249, 33}}};
constexpr std::array<glm::vec3, 6> kCividis{
    {{0, 32, 77}, {49, 68, 107}, {102, 105, 112}, {149, 143, 120}, {203, 186, 105}, {255, 234, 70}}};
constexpr std::array<glm::vec3, 3> kHeightField{{{0, 0, 255}, {255, 255, 0}, {255, 0, 0}}};

std::span<const glm::vec3> stops_of(Ramp ramp) {
  switch (ramp) {
    case Ramp::magma:
      return kMagma;
    case Ramp::plasma:
      return kPlasma;
    case Ramp::cividis:
      return kCividis;
    case Ramp::height_field:
      return kHeightField;
    case Ramp::viridis:
    case Ramp::turbo:
      break;
  }
  return kViridis;
}

// The polynomials that come with turbo (Mikhailov 2019, "Turbo, an improved rainbow colormap for visualization").
glm::dvec3 turbo(double t) {
  constexpr std::array<glm::dvec3, 6> kTerms{{{0.13572138, 0.09140261, 0.10667330},
                                              {4.61539260, 2.19418839, 12.64194608},
                                              {-42.66032258, 4.84296658, -60.58204836},
                                              {132.13108234, -14.18503333, 110.36276771},
                                              {-152.94239396, 4.27729857, -89.90310912},
                                              {59.28637943, 2.82956604, 27.34824973}}};
  glm::dvec3 color(0.0);
  for (std::size_t i = kTerms.size(); i-- > 0;) color = color * t + kTerms[i];
  return 255.0 * glm::clamp(color, 0.0, 1.0);
}

// Created, unclassified, ground, low, medium and high vegetation, building, low noise, key point, water, rail, road,
// overlap, wire guard, conductor, tower, connector, bridge, high noise.
constexpr std::array<std::uint32_t, 19> kClassColors{
    pack(160, 160, 160), pack(190, 190, 190), pack(150, 111, 74),  pack(158, 202, 110), pack(98, 168, 77),
    pack(44, 122, 58),   pack(214, 96, 77),   pack(120, 60, 120),  pack(230, 200, 80),  pack(66, 133, 200),
    pack(110, 90, 90),   pack(90, 96, 105),   pack(200, 180, 220), pack(240, 170, 60),  pack(250, 210, 60),
    pack(130, 80, 160),  pack(220, 130, 190), pack(200, 150, 120), pack(180, 40, 160)};

glm::dvec3 mixed(std::span<const glm::vec3> stops, double t) {
  const double at = t * static_cast<double>(stops.size() - 1);
  const auto low = std::min(static_cast<std::size_t>(at), stops.size() - 2);
  return glm::mix(stops[low], stops[low + 1], static_cast<float>(at - static_cast<double>(low)));
}

std::uint32_t ramp_color(Ramp ramp, double t) {
  const glm::dvec3 c = (ramp == Ramp::turbo ? turbo(t) : mixed(stops_of(ramp), t)) + 0.5;
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

std::uint32_t& rgba_of(PackedPoint& point) {
  return point.rgba;
}
std::uint32_t& rgba_of(std::uint32_t& color) {
  return color;
}

// The colour of out[i], a point or a colour alone, becomes rgba(i).
template <class Out, class Rgba>
void color_points(std::span<Out> out, const Rgba& rgba) {
  for (std::size_t i = 0; i < out.size(); ++i) rgba_of(out[i]) = rgba(i);
}

// Colours by where value(i) lies between the map's ends.
template <class Out, class Value, class Rgba>
void color_by_value(const ColorMap& map, std::span<Out> out, const Value& value, const Rgba& rgba) {
  const double stretch = map.high > map.low ? 1.0 / (map.high - map.low) : 0.0;
  color_points(out, [&](std::size_t i) {
    const double t = (value(i) - map.low) * stretch;
    return rgba(t > 0.0 ? std::min(t, 1.0) : 0.0);  // not a number becomes 0
  });
}

const Column* column_of(std::span<const Column> columns, std::string_view name) {
  const auto found = std::ranges::find_if(columns, [&](const Column& column) { return column.attribute.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

// The colours of points first, first + 1, ...: `values` are those of the map's attribute, height(i) that of point i
// where there are none.
template <class Out, class Height>
void color_all(const ColorMap& map, const Column* values, const Height& height, std::size_t first, std::span<Out> out) {
  const auto value = [&](std::size_t i) { return values ? value_at(*values, first + i) : height(first + i); };
  switch (map.kind) {
    case ColorMap::Kind::rgb8:
    case ColorMap::Kind::rgb16: {
      const auto channels = values->as<std::uint16_t>().subspan(3 * first);
      const int shift = map.kind == ColorMap::Kind::rgb16 ? 8 : 0;
      color_points(out, [&](std::size_t i) {
        return pack(channels[3 * i] >> shift & 0xFFu, channels[3 * i + 1] >> shift & 0xFFu,
                    channels[3 * i + 2] >> shift & 0xFFu);
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
      color_by_value(map, out, value, [&](double t) { return ramp_color(map.ramp, t); });
      break;
  }
}

// Points that are not to be seen lose the opacity of their colour, others get it.
template <class Out>
void hide(const ClassSet& hidden, const Column& classes, std::size_t first, std::span<Out> out) {
  constexpr std::uint32_t kOpaque = 0xFF000000u;
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double value = value_at(classes, first + i);
    const bool is_hidden =
        value >= 0.0 && value < static_cast<double>(hidden.size()) && hidden[static_cast<std::size_t>(value)];
    std::uint32_t& rgba = rgba_of(out[i]);
    rgba = is_hidden ? rgba & ~kOpaque : rgba | kOpaque;
  }
}

}  // namespace

std::span<const Ramp> all_ramps() {
  static constexpr std::array kAll{Ramp::viridis, Ramp::magma, Ramp::plasma,
                                   Ramp::cividis, Ramp::turbo, Ramp::height_field};
  return kAll;
}

std::string_view name_of(Ramp ramp) {
  constexpr std::array<std::string_view, 6> kNames{"viridis", "magma", "plasma", "cividis", "turbo", "height-field"};
  return kNames[static_cast<std::size_t>(ramp)];
}

std::optional<Ramp> ramp_named(std::string_view name) {
  for (const Ramp ramp : all_ramps())
    if (name_of(ramp) == name) return ramp;
  return std::nullopt;
}

std::string ramp_names() {
  std::vector<std::string_view> names;
  for (const Ramp ramp : all_ramps()) names.push_back(name_of(ramp));
  return fmt::format("{}", fmt::join(names, ", "));
}

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

ColorMap map_colors(const Column& values) {
  const std::string& name = values.attribute.name;
  ColorMap map{.attribute = name};
  if (has_rgb16(values)) {
    map.kind = fits_8_bits(values.as<std::uint16_t>()) ? ColorMap::Kind::rgb8 : ColorMap::Kind::rgb16;
  } else if (name == "classification") {
    map.kind = ColorMap::Kind::classes;
  } else {
    map.kind = name == "intensity" ? ColorMap::Kind::grey : ColorMap::Kind::ramp;
    std::tie(map.low, map.high) = robust_range(values.points(), [&](std::size_t i) { return value_at(values, i); });
  }
  return map;
}

ColorMap map_colors(const Cloud& cloud, const std::string& color) {
  if (color == "height") {
    ColorMap map{.attribute = color};
    std::tie(map.low, map.high) =
        robust_range(cloud.size(), [&](std::size_t i) { return static_cast<double>(cloud.positions[i].z); });
    return map;
  }
  const Column* column = cloud.find(color);
  if (!column) throw Error(fmt::format("{}: attribute {} was not read", cloud.info.path, color));
  return map_colors(*column);
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

std::vector<std::size_t> attributes_of(const ColorMap& map, const Schema& schema) {
  std::vector<std::size_t> attributes;
  if (const auto own = find_attribute(schema, map.attribute)) attributes.push_back(*own);
  const auto classes = map.hidden.any() ? find_attribute(schema, kClassAttribute) : std::nullopt;
  if (classes && map.attribute != kClassAttribute) attributes.push_back(*classes);
  return attributes;
}

std::vector<std::string> attribute_names_of(const ColorMap& map, const Schema& schema) {
  std::vector<std::string> names;
  for (const std::size_t index : attributes_of(map, schema)) names.push_back(schema[index].name);
  return names;
}

ColorMap ColorChoice::complete(ColorMap map) const {
  map.ramp = ramp;
  map.hidden = hidden;
  return map;
}

void pack_points(const ColorMap& map, std::span<const glm::ivec3> positions, std::span<const Column> columns,
                 std::size_t first, std::span<PackedPoint> out) {
  for (std::size_t i = 0; i < out.size(); ++i) out[i].position = positions[first + i];
  const auto height = [&](std::size_t i) { return static_cast<double>(positions[i].z); };
  color_all(map, column_of(columns, map.attribute), height, first, out);
  const Column* classes = map.hidden.any() ? column_of(columns, kClassAttribute) : nullptr;
  if (classes) hide(map.hidden, *classes, first, out);
}

Buffer<std::uint32_t> pack_colors(const ColorMap& map, std::span<const Column> columns, std::size_t count) {
  Buffer<std::uint32_t> colors(count);
  const Column* values = column_of(columns, map.attribute);
  if (!values) throw Error(fmt::format("attribute {} was not read", map.attribute));
  const auto no_height = [](std::size_t) { return 0.0; };
  tbb::parallel_for(Range(0, count, 65536), [&](const Range& range) {
    color_all(map, values, no_height, range.begin(), std::span(colors).subspan(range.begin(), range.size()));
  });
  const Column* classes = map.hidden.any() ? column_of(columns, kClassAttribute) : nullptr;
  if (classes) hide_classes(map.hidden, *classes, colors);
  return colors;
}

void hide_classes(const ClassSet& hidden, const Column& classes, std::span<std::uint32_t> colors) {
  tbb::parallel_for(Range(0, colors.size(), 65536), [&](const Range& range) {
    hide(hidden, classes, range.begin(), colors.subspan(range.begin(), range.size()));
  });
}

PointSet make_point_set(const Cloud& cloud, const ColorMap& map) {
  PointSet set;
  set.grid = cloud.info.grid;
  set.bounds = cloud.bounds;
  set.points.resize(cloud.size());
  tbb::parallel_for(Range(0, cloud.size(), 65536), [&](const Range& range) {
    pack_points(map, cloud.positions, cloud.columns, range.begin(),
                std::span(set.points).subspan(range.begin(), range.size()));
  });
  return set;
}

PointSet make_point_set(const Cloud& cloud, const std::string& color) {
  return make_point_set(cloud, map_colors(cloud, color));
}

}  // namespace stipple
