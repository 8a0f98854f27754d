#pragma once

#include <CLI/App.hpp>

namespace stipple {

// `stipple info`; see cli.h.
void add_info_command(CLI::App& app);

}  // namespace stipple
