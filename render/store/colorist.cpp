#include "render/store/colorist.h"

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>

#include <utility>

#include "octree/core/error.h"
#include "render/store/color_upload.h"

namespace stipple {
namespace {

using PointsOfSet = tbb::blocked_range<std::size_t>;

constexpr std::size_t kPointsOfTask = 65'536;

// By id.
Column heights_of(const PointSet& points) {
  Column heights{{.name = "height", .type = ScalarType::i32}, {}};
  heights.resize(points.size());
  const std::span<std::int32_t> z = heights.as<std::int32_t>();
  tbb::parallel_for(PointsOfSet(0, points.size(), kPointsOfTask), [&](const PointsOfSet& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) z[points.id(i)] = points.points[i].position.z;
  });
  return heights;
}

// Whether points have the colours already that `choice` asks for, but for classes that are hidden.
bool same_but_hidden(const ColorMap& map, const ColorChoice& choice) {
  return map.attribute == choice.attribute && (map.ramp == choice.ramp || map.kind != ColorMap::Kind::ramp);
}

}  // namespace

const Column* Colorist::find(const std::string& attribute) const {
  if (classes_ && classes_->attribute.name == attribute) return &*classes_;
  return values_ && values_->attribute.name == attribute ? &*values_ : nullptr;
}

void Colorist::keep(Column column) {
  (column.attribute.name == kClassAttribute ? classes_ : values_) = std::move(column);
}

void Colorist::fetch(const std::vector<std::string>& wanted, const Read& read) {
  std::vector<std::string> missing;
  for (const std::string& attribute : wanted)
    if (!find(attribute)) missing.push_back(attribute);
  if (missing.empty()) return;
  for (Column& column : read(missing)) keep(std::move(column));
}

Colorist::Colors Colorist::color(const Dataset& dataset, const ColorChoice& choice, const Read& read) {
  Buffer<std::uint32_t> colors = colors_by_id(dataset.points);
  const bool stay = same_but_hidden(dataset.colors, choice);
  const bool by_height = choice.attribute == "height";
  const bool hides = (choice.hidden.any() || dataset.colors.hidden.any()) &&
                     find_attribute(dataset.info.schema, kClassAttribute).has_value();
  std::vector<std::string> wanted;
  if (!stay && !by_height) wanted.push_back(choice.attribute);
  if (hides && (wanted.empty() || wanted.front() != kClassAttribute)) wanted.emplace_back(kClassAttribute);
  fetch(wanted, read);

  ColorMap map = dataset.colors;
  if (!stay) {
    if (by_height && !find(choice.attribute)) keep(heights_of(dataset.points));
    const Column& values = *find(choice.attribute);
    if (map.attribute != choice.attribute) map = map_colors(values);
    map = ColorChoice(choice.attribute, choice.ramp).complete(map);
    colors = pack_colors(map, {&values, 1}, colors.size());
  }
  if (hides) hide_classes(choice.hidden, *classes_, colors);
  return {choice.complete(map), std::move(colors)};
}

Dataset recolored(const Dataset& dataset, const Colorist::Colors& colors) {
  Dataset other = dataset;
  PointSet& set = other.points;
  tbb::parallel_for(PointsOfSet(0, set.size(), kPointsOfTask), [&](const PointsOfSet& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) set.points[i].rgba = colors.by_id[set.id(i)];
  });
  other.colors = colors.map;
  return other;
}

}  // namespace stipple
