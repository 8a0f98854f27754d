#include "src/viewer/panel_files.h"

#include <fmt/format.h>
#include <imgui.h>

#include <algorithm>
#include <filesystem>

#include "src/cli/cli.h"
#include "src/run/build_estimate.h"

namespace stipple {
namespace {

void show_progress(const TreeJob& job, PanelWishes& wishes) {
  const TreeJob::Status status = job.status();
  const BuildEstimate now = estimate(status.progress, status.seconds);
  const std::string done =
      fmt::format("{} {:.0f} %", name_of(status.progress.phase), 100 * share_done(status.progress));
  ImGui::TextDisabled("building %s", std::filesystem::path(status.folder).filename().c_str());
  ImGui::ProgressBar(static_cast<float>(share_done(status.progress)), {-1.0f, 0.0f}, done.c_str());
  if (now.rate > 0.0) ImGui::Text("%.1f M points a second, %.0f s left", now.rate * 1e-6, now.seconds_left);
  if (ImGui::Button("stop building")) wishes.commands.push_back(Command::cancel);
}

}  // namespace

void show_building(const PanelFacts& facts, PanelWishes& wishes) {
  if (facts.tree_job.running()) return show_progress(facts.tree_job, wishes);
  if (!facts.built_tree.empty()) {
    const std::string name = std::filesystem::path(facts.built_tree).filename().string();
    if (ImGui::Button(fmt::format("open {}", name).c_str())) wishes.open = {facts.built_tree};
  } else if (facts.can_build && ImGui::Button("build an octree (U)")) {
    wishes.commands.push_back(Command::build_tree);
  }
}

void show_pictures(const PanelFacts& facts, PanelWishes& wishes) {
  const glm::ivec2 window = facts.view.size;
  ImGui::TextDisabled("picture, when nothing is left to draw");
  for (const int times : {1, 2, 4}) {
    const glm::ivec2 size = times * window;
    if (std::max(size.x, size.y) > kLargestPictureSide) break;
    if (times > 1) ImGui::SameLine();
    if (ImGui::Button(fmt::format("{} x {}", size.x, size.y).c_str())) wishes.picture = size;
  }
}

}  // namespace stipple
