// `stipple view`: the window.
#pragma once

#include <CLI/App.hpp>

namespace stipple {

void add_view_command(CLI::App& app);

}  // namespace stipple
