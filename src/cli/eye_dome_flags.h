// Options of commands that can shade what they drew.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "render/frame/eye_dome.h"
#include "src/json/json.h"

namespace stipple {

struct EyeDomeFlags {
  bool on = false;
  std::string strength = "0.4";
  std::string radius = "1.4";
};

void add_eye_dome_flags(CLI::App& command, EyeDomeFlags& flags);

// Throws UsageError naming the option.
EyeDomeOptions eye_dome_options_of(const EyeDomeFlags& flags);

// {"strength", "radius"}, or null where nothing was shaded: a picture's provenance.
Json json_of(const std::optional<EyeDomeOptions>& shading);

}  // namespace stipple
