#include "src/viewer/legend.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace stipple {
namespace {

constexpr std::array<std::string_view, 19> kClassNames{"created, never classified",
                                                       "unclassified",
                                                       "ground",
                                                       "low vegetation",
                                                       "medium vegetation",
                                                       "high vegetation",
                                                       "building",
                                                       "low noise",
                                                       "key point",
                                                       "water",
                                                       "rail",
                                                       "road",
                                                       "overlap",
                                                       "wire, guard",
                                                       "wire, conductor",
                                                       "transmission tower",
                                                       "connector",
                                                       "bridge deck",
                                                       "high noise"};

// Values that differ by whole numbers and are so few have a swatch each.
constexpr int kMostSwatches = 16;

void show_swatch(std::uint32_t color) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side}, color);
  ImGui::Dummy({side, side});
  ImGui::SameLine();
}

void show_line(const std::string& line) {
  ImGui::TextUnformatted(line.c_str());
}

// A swatch for each number of returns, say.
void show_numbers(const Dataset& dataset, int numbers) {
  const std::vector<std::uint32_t> colors = legend_colors(dataset.colors, numbers);
  for (int i = 0; i < numbers; ++i) {
    if (i % 8 != 0) ImGui::SameLine();
    show_swatch(colors[static_cast<std::size_t>(i)]);
    show_line(fmt::format("{:.0f}", dataset.colors.low + i));
  }
}

void show_stretch(const Dataset& dataset) {
  constexpr int kSteps = 64;
  const std::vector<std::uint32_t> colors = legend_colors(dataset.colors, kSteps);
  ImDrawList& list = *ImGui::GetWindowDrawList();
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float width = ImGui::CalcItemWidth();
  const float height = ImGui::GetTextLineHeight();
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const float left = at.x + width * static_cast<float>(i) / kSteps;
    list.AddRectFilled({left, at.y}, {left + width / kSteps + 1.0f, at.y + height}, colors[i]);
  }
  ImGui::Dummy({width, height});
  const auto [low, high] =
      range_text(legend_value(dataset, dataset.colors.low), legend_value(dataset, dataset.colors.high));
  show_line(low + " to " + high);
}

bool counts(const Dataset& dataset) {
  const auto index = find_attribute(dataset.info.schema, dataset.colors.attribute);
  if (!index) return false;
  const Attribute& attribute = dataset.info.schema[*index];
  const bool whole = attribute.type != ScalarType::f32 && attribute.type != ScalarType::f64 && attribute.scale == 1.0;
  return whole && dataset.colors.high - dataset.colors.low < kMostSwatches;
}

void show_values(const Dataset& dataset) {
  if (counts(dataset))
    show_numbers(dataset, static_cast<int>(dataset.colors.high - dataset.colors.low) + 1);
  else
    show_stretch(dataset);
}

void choose_ramp(ColorChoice& choice) {
  if (!ImGui::BeginCombo("ramp", std::string(name_of(choice.ramp)).c_str())) return;
  for (const Ramp ramp : all_ramps())
    if (ImGui::Selectable(std::string(name_of(ramp)).c_str(), ramp == choice.ramp)) choice.ramp = ramp;
  ImGui::EndCombo();
}

// A box for each class to draw its points or not; colours where they are the classes'.
void show_classes(const Dataset& dataset, ColorChoice& choice) {
  if (!find_attribute(dataset.info.schema, kClassAttribute)) return;
  const bool hides = choice.hidden.any();
  if (!ImGui::TreeNode("classes", "%s", hides ? "classes (some are hidden)" : "classes")) return;
  const bool colored = dataset.colors.kind == ColorMap::Kind::classes;
  const std::vector<std::uint32_t> colors = legend_colors(dataset.colors, static_cast<int>(kClassNames.size()));
  for (std::size_t i = 0; i < kClassNames.size(); ++i) {
    if (colored) show_swatch(colors[i]);
    bool shown = !choice.hidden[i];
    if (ImGui::Checkbox(fmt::format("{} {}", i, kClassNames[i]).c_str(), &shown)) choice.hidden.set(i, !shown);
  }
  if (hides && ImGui::Button("show all")) choice.hidden.reset();
  ImGui::TreePop();
}

}  // namespace

std::vector<std::uint32_t> legend_colors(const ColorMap& map, int steps) {
  if (map.kind == ColorMap::Kind::rgb8 || map.kind == ColorMap::Kind::rgb16) return {};
  // Points whose height is the value
  ColorMap by_height = map;
  by_height.attribute = "height";
  by_height.hidden.reset();
  by_height.low = 0.0;
  by_height.high = steps - 1;
  std::vector<glm::ivec3> values;
  for (int i = 0; i < steps; ++i) values.emplace_back(0, 0, i);
  std::vector<PackedPoint> points(values.size());
  pack_points(by_height, values, {}, 0, points);
  std::vector<std::uint32_t> colors;
  for (const PackedPoint& point : points) colors.push_back(point.rgba);
  return colors;
}

std::string_view class_name(int value) {
  return value >= 0 && value < static_cast<int>(kClassNames.size()) ? kClassNames[static_cast<std::size_t>(value)] : "";
}

double legend_value(const Dataset& dataset, double mapped) {
  const Grid& grid = dataset.points.grid;
  return dataset.colors.attribute == "height" ? grid.offset.z + grid.scale.z * mapped : mapped;
}

std::array<std::string, 2> range_text(double low, double high) {
  const double range = high - low;
  if (!(range > 0.0) || !std::isfinite(range)) return {fmt::format("{:.6g}", low), fmt::format("{:.6g}", high)};
  const int decimals = std::clamp(2 - static_cast<int>(std::floor(std::log10(range))), 0, 12);
  return {fmt::format("{:.{}f}", low, decimals), fmt::format("{:.{}f}", high, decimals)};
}

void show_legend(const Dataset& dataset, ColorChoice& choice) {
  switch (dataset.colors.kind) {
    case ColorMap::Kind::rgb8:
    case ColorMap::Kind::rgb16:
    case ColorMap::Kind::classes:
      break;
    case ColorMap::Kind::grey:
      show_stretch(dataset);
      break;
    case ColorMap::Kind::ramp:
      show_values(dataset);
      choose_ramp(choice);
      break;
  }
  show_classes(dataset, choice);
}

}  // namespace stipple
