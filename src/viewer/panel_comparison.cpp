#include "src/viewer/panel_comparison.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "src/viewer/wires.h"

namespace stipple {
namespace {

using Shown = ReferenceComparison::Shown;

// What a curve's top means, in dB: of converged pictures all but a few pixels are those of the reference.
constexpr double kHighest = 80.0;
constexpr double kLowest = 10.0;
constexpr std::array<ImU32, 2> kSideColors{IM_COL32(120, 200, 255, 255), IM_COL32(255, 170, 80, 255)};

std::string decibels(double value) {
  return std::isinf(value) ? "equal" : fmt::format("{:.1f} dB", value);
}

void show_swatch(ImU32 color, const char* what) {
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float side = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddRectFilled(at, {at.x + side, at.y + side}, color);
  ImGui::Dummy({side, side});
  ImGui::SameLine();
  ImGui::TextUnformatted(what);
}

// Time to the right, from the view's begin on; the error upwards.
void plot_curves(const ReferenceComparison& comparison) {
  double longest = 0.1;
  for (const std::size_t side : {0u, 1u})
    if (!comparison.curve(side).empty()) longest = std::max(longest, comparison.curve(side).back().seconds);
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const ImVec2 size{ImGui::GetContentRegionAvail().x, 5.0f * ImGui::GetTextLineHeight()};
  ImDrawList& list = *ImGui::GetWindowDrawList();
  list.AddRectFilled(at, {at.x + size.x, at.y + size.y}, IM_COL32(15, 18, 22, 255));
  const auto height_of = [&](double db) {
    const double t = (std::clamp(db, kLowest, kHighest) - kLowest) / (kHighest - kLowest);
    return at.y + size.y * static_cast<float>(1.0 - t);
  };
  for (double db = 20.0; db < kHighest; db += 20.0) {
    list.AddLine({at.x, height_of(db)}, {at.x + size.x, height_of(db)}, IM_COL32(60, 66, 74, 255));
    list.AddText({at.x + 2.0f, height_of(db)}, IM_COL32(110, 118, 128, 255), fmt::format("{:.0f} dB", db).c_str());
  }
  for (const std::size_t side : {0u, 1u}) {
    std::vector<ImVec2> line;
    for (const ReferenceComparison::Sample& sample : comparison.curve(side))
      line.push_back({at.x + size.x * static_cast<float>(sample.seconds / longest), height_of(sample.psnr_db)});
    if (line.size() == 1) line.push_back({at.x + size.x, line.front().y});
    list.AddPolyline(line.data(), static_cast<int>(line.size()), kSideColors[side], ImDrawFlags_None, 1.5f);
  }
  ImGui::Dummy(size);
  ImGui::TextDisabled("PSNR over %.2f s of this view", longest);
}

}  // namespace

void show_selection(const PanelFacts& facts, PanelWishes& wishes) {
  bool frozen = facts.stage.frozen();
  if (ImGui::Checkbox("frozen (F)", &frozen)) wishes.commands.push_back(Command::freeze);
  ImGui::SameLine();
  bool boxes = facts.box_counts.has_value();
  if (ImGui::Checkbox("boxes (O)", &boxes)) wishes.commands.push_back(Command::boxes);
  if (!facts.box_counts) return;
  constexpr std::array kNames{"not begun", "streamed in part", "all drawn", "occluded"};
  for (std::size_t state = 0; state < kNames.size(); ++state)
    show_swatch(kBoxColors[state], fmt::format("{} {}", (*facts.box_counts)[state], kNames[state]).c_str());
  if (std::reduce(facts.box_counts->begin(), facts.box_counts->end()) > kMostBoxes)
    ImGui::TextDisabled("the nearest %zu are shown", kMostBoxes);
}

void show_comparison(const PanelFacts& facts, PanelWishes& wishes) {
  const ReferenceComparison& comparison = facts.comparison;
  for (const Shown shown : {Shown::picture, Shown::difference, Shown::reference}) {
    if (shown != Shown::picture) ImGui::SameLine();
    if (!ImGui::RadioButton(std::string(name_of(shown)).c_str(), comparison.shown() == shown)) continue;
    for (int turns = static_cast<int>(comparison.shown()); turns % 3 != static_cast<int>(shown); ++turns)
      wishes.commands.push_back(Command::compare);
  }
  if (!comparison.on()) return;
  if (comparison.busy()) ImGui::TextDisabled("drawing the reference");
  if (comparison.shown() == Shown::difference) {
    show_swatch(IM_COL32(230, 40, 200, 255), "a point is missing");
    show_swatch(IM_COL32(255, 225, 60, 255), "another colour");
    show_swatch(IM_COL32(40, 210, 230, 255), "a point where none should be");
  }
  for (const Stage::Side side : {Stage::left, Stage::right}) {
    const ReferenceComparison::Curve& curve = comparison.curve(side);
    const auto& mode = facts.stage.pane(side).mode();
    if (curve.empty() || !mode || (side == Stage::right && !facts.stage.is_split())) continue;
    show_swatch(kSideColors[side], fmt::format("{}: {}", name_of(*mode), decibels(curve.back().psnr_db)).c_str());
  }
  if (!comparison.curve(Stage::left).empty()) plot_curves(comparison);
  if (ImGui::Button("draw anew (N)")) wishes.commands.push_back(Command::again);
}

}  // namespace stipple
