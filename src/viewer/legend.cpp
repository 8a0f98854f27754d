#include "src/viewer/legend.h"

#include <fmt/format.h>
#include <imgui.h>

#include <array>

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

void show_ramp(const Dataset& dataset) {
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
  const std::string ends = fmt::format("{:.6g} to {:.6g}", legend_value(dataset, dataset.colors.low),
                                       legend_value(dataset, dataset.colors.high));
  ImGui::TextUnformatted(ends.c_str());
}

void show_classes(const Dataset& dataset) {
  const std::vector<std::uint32_t> colors = legend_colors(dataset.colors, static_cast<int>(kClassNames.size()));
  if (!ImGui::TreeNode("classes")) return;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    const ImVec2 at = ImGui::GetCursorScreenPos();
    const float side = ImGui::GetTextLineHeight();
    ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side}, colors[i]);
    ImGui::Dummy({side, side});
    ImGui::SameLine();
    const std::string line = fmt::format("{} {}", i, class_name(static_cast<int>(i)));
    ImGui::TextUnformatted(line.c_str());
  }
  ImGui::TreePop();
}

}  // namespace

std::vector<std::uint32_t> legend_colors(const ColorMap& map, int steps) {
  if (map.kind == ColorMap::Kind::rgb8 || map.kind == ColorMap::Kind::rgb16) return {};
  // Points whose height is the value
  ColorMap by_height = map;
  by_height.attribute = "height";
  by_height.low = 0.0;
  by_height.high = steps - 1;
  std::vector<glm::ivec3> values;
  for (int i = 0; i < steps; ++i) values.emplace_back(0, 0, i);
  std::vector<PackedPoint> points(values.size());
  pack_points(by_height, values, nullptr, 0, points);
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

void show_legend(const Dataset& dataset) {
  switch (dataset.colors.kind) {
    case ColorMap::Kind::rgb8:
    case ColorMap::Kind::rgb16:
      break;
    case ColorMap::Kind::classes:
      show_classes(dataset);
      break;
    case ColorMap::Kind::grey:
    case ColorMap::Kind::ramp:
      show_ramp(dataset);
      break;
  }
}

}  // namespace stipple
