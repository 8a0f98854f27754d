// Options of commands that choose how values become colours, and which points are drawn.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "render/store/colorize.h"
#include "src/json/json.h"

namespace stipple {

struct ColorFlags {
  std::string ramp = "viridis";
  std::vector<std::string> hide;
};

void add_color_flags(CLI::App& command, ColorFlags& flags);

// `attribute`: of --color. Throws UsageError naming the option.
ColorChoice color_choice_of(const std::string& attribute, const ColorFlags& flags);

// "7,18": as --hide-class takes them.
std::string text_of(const ClassSet& classes);

// {"ramp", "hidden_classes"}: a picture's provenance.
Json color_provenance(const ColorMap& map);

}  // namespace stipple
