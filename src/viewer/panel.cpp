#include "src/viewer/panel.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "src/cli/cli.h"
#include "src/viewer/legend.h"
#include "src/viewer/panel_comparison.h"
#include "src/viewer/panel_files.h"
#include "src/viewer/panel_overlays.h"

namespace stipple {
namespace {

constexpr float kWidth = 310.0f;  // of the panel, unscaled

void text(const std::string& line) {
  ImGui::TextUnformatted(line.c_str(), line.c_str() + line.size());
}

void wrapped(const std::string& line) {
  ImGui::PushTextWrapPos(0.0f);
  text(line);
  ImGui::PopTextWrapPos();
}

void alarm(const std::string& line) {
  ImGui::PushStyleColor(ImGuiCol_Text, {1.0f, 0.55f, 0.45f, 1.0f});
  wrapped(line);
  ImGui::PopStyleColor();
}

const char* phase_text(WorkStatus::Phase phase) {
  switch (phase) {
    case WorkStatus::Phase::opening:
      return "opening";
    case WorkStatus::Phase::reading:
      return "reading";
    case WorkStatus::Phase::sorting:
      return "building the octree";
    case WorkStatus::Phase::preparing:
      return "preparing the method";
    case WorkStatus::Phase::coloring:
      return "colouring the points";
    case WorkStatus::Phase::idle:
      break;
  }
  return "";
}

void show_work(const WorkStatus& work, PanelWishes& wishes) {
  if (work.phase == WorkStatus::Phase::idle) return;
  if (work.phase == WorkStatus::Phase::reading && work.total > 0) {
    const double part = static_cast<double>(work.points) / static_cast<double>(work.total);
    ImGui::ProgressBar(static_cast<float>(part), {-1.0f, 0.0f});
    const double rate = work.seconds > 0.0 ? static_cast<double>(work.points) / work.seconds : 0.0;
    text(fmt::format("{} of {} points", with_thousands(work.points), with_thousands(work.total)));
    if (rate > 0.0)
      text(fmt::format("{:.1f} M a second, {:.0f} s left", rate * 1e-6,
                       static_cast<double>(work.total - std::min(work.points, work.total)) / rate));
  } else {
    text(fmt::format("{} ({:.0f} s)", phase_text(work.phase), work.seconds));
  }
  if (ImGui::Button("cancel")) wishes.commands.push_back(Command::cancel);
}

void show_recent(const PanelFacts& facts, PanelWishes& wishes) {
  if (facts.recent.empty()) return;
  ImGui::TextDisabled("opened before");
  int number = 0;
  for (const std::vector<std::string>& inputs : facts.recent) {
    std::string label = std::filesystem::path(inputs.front()).filename().string();
    if (inputs.size() > 1) label += fmt::format(" and {} more", inputs.size() - 1);
    if (ImGui::Selectable(fmt::format("{}##{}", label, number++).c_str())) wishes.open = inputs;
    if (ImGui::IsItemHovered()) ImGui::SetTooltip("%s", inputs.front().c_str());
  }
}

void show_cloud(const PanelFacts& facts, PanelWishes& wishes) {
  const Stage& stage = facts.stage;
  if (const auto& info = stage.info()) {
    wrapped(std::filesystem::path(info->path).filename().empty()
                ? info->path
                : std::filesystem::path(info->path).filename().string());
    text(fmt::format("{} {}, {} points", info->format, info->version, with_thousands(info->point_count)));
  } else if (facts.work.phase == WorkStatus::Phase::idle) {
    wrapped("Drop point clouds on the window: files, folders of files, octrees.");
    show_recent(facts, wishes);
  }
  show_work(facts.work, wishes);
  if (const Unread unread = stage.unread(); unread.parts > 0) alarm(unread.message());
  if (stage.error().empty()) return;
  alarm(stage.error());
  if (ImGui::Button("dismiss")) wishes.dismiss_error = true;
}

constexpr std::array kMethods{Mode::unstructured, Mode::hierarchical, Mode::hybrid,
                              Mode::brute_force,  Mode::lod,          Mode::subsample};

// A column of buttons for each side.
void show_methods(const PanelFacts& facts, PanelWishes& wishes) {
  const Stage& stage = facts.stage;
  for (std::size_t i = 0; i < kMethods.size(); ++i) {
    const Mode mode = kMethods[i];
    const auto button = [&](Stage::Side side, const std::string& label) {
      if (ImGui::RadioButton(label.c_str(), stage.wanted(side) == mode)) wishes.mode.emplace(mode, side);
    };
    const auto waits = [&](Stage::Side side) {
      return stage.wanted(side) == mode && stage.pane(side).mode() != mode && stage.info();
    };
    if (stage.is_split()) {
      button(Stage::left, fmt::format("##left{}", i));
      ImGui::SameLine();
    }
    const bool waiting = waits(Stage::left) || (stage.is_split() && waits(Stage::right));
    const std::string label = fmt::format("F{}  {}{}", i + 1, name_of(mode), waiting ? " ..." : "");
    button(stage.is_split() ? Stage::right : Stage::left, label);
  }
  bool split = stage.is_split();
  if (ImGui::Checkbox("two side by side", &split)) wishes.commands.push_back(Command::split);
  bool two_eyes = facts.two_eyes;
  if (ImGui::Checkbox("two eyes", &two_eyes)) wishes.commands.push_back(Command::two_eyes);
}

void show_pace(const PanelFacts& facts, PanelWishes& wishes) {
  BudgetPolicy policy = facts.policy;
  bool steered = policy.frames_per_second.has_value();
  bool changed = ImGui::Checkbox("steer to a frame rate", &steered);
  if (changed) policy.frames_per_second = steered ? std::optional(30.0) : std::nullopt;
  if (steered) {
    auto rate = static_cast<float>(policy.frames_per_second.value_or(30.0));
    changed |= ImGui::SliderFloat("frames/s", &rate, 5.0f, 120.0f, "%.0f", ImGuiSliderFlags_AlwaysClamp);
    policy.frames_per_second = rate;
  } else {
    auto points = static_cast<float>(policy.points) * 1e-3f;
    changed |= ImGui::SliderFloat("k points", &points, 1.0f, 4000.0f, "%.0f",
                                  ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
    policy.points = static_cast<std::uint32_t>(points * 1e3f);
  }
  if (changed) wishes.policy = policy;
  const bool done = facts.stage.complete(facts.view);
  text(
      fmt::format("{:.0f} frames/s, {} points a frame", facts.frames_per_second, with_thousands(facts.stage.filled())));
  if (!facts.frame_ms.empty()) {
    constexpr float kTop = 100.0f;  // ms
    const std::string label = fmt::format("{:.0f} ms", facts.frame_ms.back());
    ImGui::PlotLines("##times", facts.frame_ms.data(), static_cast<int>(facts.frame_ms.size()), 0, label.c_str(), 0.0f,
                     kTop, {ImGui::GetContentRegionAvail().x, 2.5f * ImGui::GetTextLineHeight()});
  }
  for (const Stage::Side side : {Stage::left, Stage::right}) {
    if (side == Stage::right && !facts.stage.is_split()) break;
    const Pane& pane = facts.stage.pane(side);
    const bool complete = done && pane.unread().parts == 0;
    text(fmt::format("{}: {} points{}", pane.mode() ? name_of(*pane.mode()) : "preview",
                     with_thousands(pane.filled_for_view()), complete ? ", complete" : ""));
  }
}

void show_sizes(const PanelFacts& facts, PanelWishes& wishes) {
  const PointSize& now = facts.point_size;
  auto pixels = static_cast<float>(now.pixels);
  if (ImGui::SliderFloat("point size", &pixels, 1.0f, 10.0f, "%.0f px", ImGuiSliderFlags_AlwaysClamp) &&
      std::round(pixels) != static_cast<float>(now.pixels))
    wishes.point_size = PointSize(std::round(pixels), now.world);
  // In the cloud's own units
  auto world = static_cast<float>(now.world);
  const auto most = static_cast<float>(std::max(32.0 * facts.spacing, now.world));
  if (ImGui::SliderFloat("splat size", &world, 0.0f, most, now.world > 0.0 ? "%.3g" : "none",
                         ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic))
    wishes.point_size = PointSize(now.pixels, world);
}

void show_look(const PanelFacts& facts, PanelWishes& wishes) {
  const auto& info = facts.stage.info();
  const Dataset* dataset = facts.stage.dataset();
  if (info && dataset) {
    ColorChoice choice = facts.color;
    choice.attribute = dataset->colors.attribute;
    const ColorChoice before = choice;
    if (ImGui::BeginCombo("colour", before.attribute.c_str())) {
      for (const std::string& name : colors_of(*info))
        if (ImGui::Selectable(name.c_str(), name == before.attribute)) choice.attribute = name;
      ImGui::EndCombo();
    }
    show_legend(*dataset, choice);
    if (choice != before) wishes.color = choice;
  }
  show_sizes(facts, wishes);
  std::array<float, 3> color{};
  for (std::size_t c = 0; c < 3; ++c) color[c] = static_cast<float>(facts.background >> (16 - 8 * c) & 0xFFu) / 255.0f;
  if (ImGui::ColorEdit3("background", color.data(), ImGuiColorEditFlags_NoInputs)) {
    std::uint32_t packed = 0;
    for (const float c : color) packed = packed << 8 | static_cast<std::uint32_t>(std::lround(c * 255.0f));
    wishes.background = packed;
  }
}

void show_shading(const PanelFacts& facts, PanelWishes& wishes) {
  bool shaded = facts.shaded;
  if (ImGui::Checkbox("eye-dome lighting", &shaded)) wishes.commands.push_back(Command::shade);
  if (!facts.shaded) return;
  auto strength = static_cast<float>(facts.eye_dome.strength);
  auto radius = static_cast<float>(facts.eye_dome.radius);
  bool changed = ImGui::SliderFloat("strength", &strength, 0.01f, 10.0f, "%.2f",
                                    ImGuiSliderFlags_AlwaysClamp | ImGuiSliderFlags_Logarithmic);
  changed |= ImGui::SliderFloat("radius", &radius, 1.0f, 10.0f, "%.1f px", ImGuiSliderFlags_AlwaysClamp);
  if (changed) wishes.eye_dome = {.strength = strength, .radius = radius};
}

void show_picks(const PanelFacts& facts) {
  if (facts.under_cursor) {
    const auto& place = *facts.under_cursor;
    ImGui::TextDisabled("cursor  %s  %s  %s", place[0].c_str(), place[1].c_str(), place[2].c_str());
  } else {
    ImGui::TextDisabled("cursor  -");
  }
  char letter = 'A';
  for (const Pick& pick : facts.picks) {
    text(fmt::format("{}  x {}\n   y {}\n   z {}", letter++, pick.place[0], pick.place[1], pick.place[2]));
    ImGui::Indent();
    if (pick.values.empty()) ImGui::TextDisabled("reading its attributes");
    for (const auto& [name, value] : pick.values) wrapped(name.empty() ? value : fmt::format("{}: {}", name, value));
    ImGui::Unindent();
  }
  if (facts.picks.size() == 2) {
    const glm::dvec3 d = facts.picks[1].world - facts.picks[0].world;
    text(fmt::format("distance {:.6g}", glm::length(d)));
    text(fmt::format("level {:.6g}, height {:.6g}", glm::length(glm::dvec2(d)), d.z));
  }
}

bool section(const char* name) {
  return ImGui::CollapsingHeader(name, ImGuiTreeNodeFlags_DefaultOpen);
}

}  // namespace

std::vector<std::string> colors_of(const SourceInfo& info) {
  std::vector<std::string> names;
  for (const char* usual : {"rgb", "intensity"})
    if (find_attribute(info.schema, usual)) names.push_back(usual);
  names.push_back("height");
  for (const Attribute& attribute : info.schema)
    if (std::ranges::find(names, attribute.name) == names.end()) names.push_back(attribute.name);
  return names;
}

PanelWishes show_panel(const PanelFacts& facts) {
  PanelWishes wishes;
  show_overlays(facts, wishes);
  if (!facts.panel_shown) return wishes;
  const float margin = 10.0f * facts.scale;
  const ImVec2 display = ImGui::GetIO().DisplaySize;
  ImGui::SetNextWindowPos({margin, margin}, ImGuiCond_Always);
  ImGui::SetNextWindowSizeConstraints({kWidth * facts.scale, 0.0f},
                                      {kWidth * facts.scale, std::max(50.0f, display.y - 2.0f * margin)});
  ImGui::Begin("stipple", nullptr,
               ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize | ImGuiWindowFlags_NoTitleBar);
  ImGui::PushItemWidth(150.0f * facts.scale);
  show_cloud(facts, wishes);
  show_building(facts, wishes);
  if (facts.stage.info()) {
    if (section("method")) {
      show_methods(facts, wishes);
      show_pace(facts, wishes);
      show_selection(facts, wishes);
    }
    if (section("comparison")) show_comparison(facts, wishes);
    if (section("points")) {
      show_look(facts, wishes);
      show_shading(facts, wishes);
    }
    if (section("picked")) show_picks(facts);
    if (section("files")) show_pictures(facts, wishes);
  }
  ImGui::PopItemWidth();
  ImGui::End();
  return wishes;
}

}  // namespace stipple
