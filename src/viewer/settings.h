// What the viewer remembers from one time to the next.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "render/frame/eye_dome.h"

namespace stipple {

struct ViewerSettings {
  std::uint32_t background = 0x808080;
  double point_size = 1.0;
  double frames_per_second = 30.0;
  bool shaded = false;  // by eye-dome lighting
  EyeDomeOptions eye_dome;
  bool panel_shown = true;

  bool operator==(const ViewerSettings&) const = default;
};

// Inputs that were opened together, the latest first.
using RecentInputs = std::vector<std::vector<std::string>>;

// Puts `inputs` first, as absolute paths. Keeps ten.
void remember(RecentInputs& recent, const std::vector<std::string>& inputs);

// $XDG_CONFIG_HOME/stipple/viewer.json, or in ~/.config; empty where neither is set.
std::string settings_path();
// $XDG_STATE_HOME/stipple/recent.json, or in ~/.local/state; empty where neither is set.
std::string recent_path();

// What is missing, or no number, is as by default: an old file or a damaged one is no reason not to start.
ViewerSettings read_settings(const std::string& path);
RecentInputs read_recent(const std::string& path);

// Makes the folder. Throws Error when it cannot be written; nothing is done for an empty path.
void write_settings(const std::string& path, const ViewerSettings& settings);
void write_recent(const std::string& path, const RecentInputs& recent);

}  // namespace stipple
