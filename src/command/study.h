// `stipple study`: methods compared.
#pragma once

#include <CLI/App.hpp>

namespace stipple {

void add_study_command(CLI::App& app);

}  // namespace stipple
