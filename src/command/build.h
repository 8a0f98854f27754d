// `stipple build`: octrees on disk from point clouds of any size.
#pragma once

#include <CLI/App.hpp>

namespace stipple {

void add_build_command(CLI::App& app);

}  // namespace stipple
