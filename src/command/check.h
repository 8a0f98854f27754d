#pragma once

#include <CLI/App.hpp>

namespace stipple {

// `stipple check`; see cli.h.
void add_check_command(CLI::App& app);

}  // namespace stipple
