#pragma once

#include <CLI/App.hpp>

namespace stipple {

// `stipple scene`; see cli.h.
void add_scene_command(CLI::App& app);

}  // namespace stipple
