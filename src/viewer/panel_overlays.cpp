#include "src/viewer/panel_overlays.h"

#include <imgui.h>

#include <string>
#include <vector>

namespace stipple {
namespace {

constexpr ImU32 kPickColor = IM_COL32(255, 210, 60, 255);

// Crosses at the picks, and a line between them, as an eye sees them.
void mark_picks(const PanelFacts& facts, std::size_t eye) {
  const View view = facts.view.of_eye(eye);
  const double eyes = static_cast<double>(facts.view.eyes());
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImGuiIO& io = ImGui::GetIO();
  std::vector<ImVec2> places;
  char letter = 'A';
  for (const Pick& pick : facts.picks) {
    const glm::dvec3 r = pick.world - view.eye;
    const double depth = glm::dot(view.forward, r);
    const char name[2] = {letter++, 0};
    if (depth <= view.near) continue;
    const double x = 0.5 * (1.0 + glm::dot(view.right, r) * view.cot_x / depth);
    const double y = 0.5 * (1.0 - glm::dot(view.up, r) * view.cot_y / depth);
    if (eyes > 1.0 && (x < 0.0 || x > 1.0)) continue;  // in the other's picture
    const ImVec2 at{static_cast<float>((static_cast<double>(eye) + x) / eyes) * io.DisplaySize.x,
                    static_cast<float>(y) * io.DisplaySize.y};
    const float arm = 7.0f * facts.scale;
    list.AddLine({at.x - arm, at.y}, {at.x + arm, at.y}, kPickColor, 2.0f);
    list.AddLine({at.x, at.y - arm}, {at.x, at.y + arm}, kPickColor, 2.0f);
    list.AddText({at.x + arm, at.y - 2.0f * arm}, kPickColor, name);
    places.push_back(at);
  }
  if (places.size() == 2) list.AddLine(places[0], places[1], kPickColor, 1.0f);
}

void show_divider(const PanelFacts& facts) {
  const Stage& stage = facts.stage;
  if (!stage.is_split() || !stage.frame(Stage::right)) return;
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const auto name = [&](Stage::Side side) {
    return std::string(stage.pane(side).mode() ? name_of(*stage.pane(side).mode()) : "preview");
  };
  const auto put = [&](const std::string& label, float x) {
    const ImVec2 size = ImGui::CalcTextSize(label.c_str());
    const float margin = 4.0f * facts.scale;
    const float y = display.y - size.y - 2.0f * margin;
    list.AddRectFilled({x - margin, y - margin}, {x + size.x + margin, y + size.y + margin}, IM_COL32(25, 28, 33, 200));
    list.AddText({x, y}, IM_COL32_WHITE, label.c_str());
  };
  const float gap = 12.0f * facts.scale;
  if (!facts.divider) {
    put(name(facts.right_alone ? Stage::right : Stage::left), 0.5f * display.x);
    return;
  }
  const float x = static_cast<float>(*facts.divider) * display.x / static_cast<float>(facts.view.size.x);
  list.AddLine({x, 0.0f}, {x, display.y}, IM_COL32(255, 255, 255, 200), 1.5f * facts.scale);
  put(name(Stage::left), x - gap - ImGui::CalcTextSize(name(Stage::left).c_str()).x);
  put(name(Stage::right), x + gap);
}

void show_keys(const PanelFacts& facts, PanelWishes& wishes) {
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({0.5f * display.x, 0.5f * display.y}, ImGuiCond_Always, {0.5f, 0.5f});
  bool open = true;
  ImGui::Begin("keys", &open,
               ImGuiWindowFlags_NoCollapse | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoMove);
  for (const KeyEntry& entry : key_table()) {
    if (!*entry.keys) continue;
    ImGui::TextUnformatted(entry.keys);
    ImGui::SameLine(110.0f * facts.scale);
    ImGui::TextUnformatted(entry.what);
  }
  ImGui::End();
  if (!open) wishes.commands.push_back(Command::keys);
}

void show_hint(const PanelFacts& facts) {
  ImDrawList& list = *ImGui::GetBackgroundDrawList();
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  const std::string line = facts.note.empty() ? "? shows the keys" : facts.note;
  const ImVec2 size = ImGui::CalcTextSize(line.c_str());
  const ImVec2 at{display.x - size.x - 12.0f * facts.scale, display.y - size.y - 8.0f * facts.scale};
  const float margin = 5.0f * facts.scale;
  list.AddRectFilled({at.x - margin, at.y - margin}, {at.x + size.x + margin, at.y + size.y + margin},
                     IM_COL32(25, 28, 33, 200), 4.0f);
  list.AddText(at, IM_COL32(225, 225, 225, 255), line.c_str());
}

}  // namespace

void show_overlays(const PanelFacts& facts, PanelWishes& wishes) {
  for (std::size_t eye = 0; eye < facts.view.eyes(); ++eye) mark_picks(facts, eye);
  show_divider(facts);
  show_hint(facts);
  if (facts.keys_shown) show_keys(facts, wishes);
}

}  // namespace stipple
