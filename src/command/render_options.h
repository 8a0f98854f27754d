// What `stipple render` is told.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>
#include <vector>

#include "render/method/method.h"
#include "src/cli/color_flags.h"
#include "src/cli/draw_options.h"
#include "src/cli/eye_dome_flags.h"
#include "src/cli/stereo_flags.h"

namespace stipple {

// The mode that is no method.
inline constexpr const char* kReference = "reference";

struct RenderOptions {
  std::vector<std::string> inputs;
  std::string output;
  std::string mode = "hybrid";
  std::string camera;
  std::string view;
  std::optional<double> time;
  std::string eye;
  std::string target;
  std::string up = "0,0,1";
  double fov_deg = 60.0;
  std::string until = "converged";
  std::string stats;
  std::string position_out;
  std::string depth_out;
  bool while_loading = false;
  DrawOptions draw;
  ColorFlags color;
  EyeDomeFlags eye_dome;
  StereoFlags stereo;
  bool json = false;
};

void add_render_options(CLI::App& command, RenderOptions& options);

// Everything but the camera that can be checked before points are read. `mode`: that of --mode, if a method has the
// name. Throws UsageError naming the option.
void check_options(const RenderOptions& options, const std::optional<Mode>& mode);

// What is asked for by --edl. Throws UsageError naming the option.
std::optional<EyeDomeOptions> shading_of(const RenderOptions& options);

}  // namespace stipple
