// `stipple render`: one picture.
#pragma once

#include <CLI/App.hpp>

namespace stipple {

void add_render_command(CLI::App& app);

}  // namespace stipple
