// `stipple bench`: the parts of the program, timed.
#pragma once

#include <CLI/App.hpp>

namespace stipple {

void add_bench_command(CLI::App& app);

}  // namespace stipple
