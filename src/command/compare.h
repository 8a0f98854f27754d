#pragma once

#include <CLI/App.hpp>

namespace stipple {

// `stipple compare`; see cli.h.
void add_compare_command(CLI::App& app);

}  // namespace stipple
