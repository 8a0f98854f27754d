#include "src/viewer/command_line.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>

#include "src/cli/color_flags.h"

namespace stipple {
namespace {

std::string argument_of(const glm::dvec3& v) {
  return fmt::format("{},{},{}", v.x, v.y, v.z);
}

}  // namespace

std::string quoted(const std::string& word) {
  const auto plain = [](unsigned char c) {
    return std::isalnum(c) || std::string_view("/._-+,:=@").find(static_cast<char>(c)) != std::string_view::npos;
  };
  if (!word.empty() && std::ranges::all_of(word, plain)) return word;
  std::string text(1, '\'');
  for (const char c : word) {
    if (c == '\'')
      text += "'\\''";
    else
      text += c;
  }
  text += '\'';
  return text;
}

std::string text_of(const RenderCommand& command) {
  std::string line = "stipple render";
  for (const std::string& input : command.inputs) line += fmt::format(" {}", quoted(input));
  line += fmt::format(" -o view.png --mode {} --raster {} --size {}x{} --eye={} --target={} --up={} --fov {}",
                      command.mode, command.raster, command.size.x, command.size.y, argument_of(command.camera.eye),
                      argument_of(command.camera.target), argument_of(command.camera.up), command.camera.fov_deg);
  line += fmt::format(" --color {} --point-size {} --background {:06x}", quoted(command.colors.attribute),
                      command.point_size.pixels, command.background);
  if (command.eyes_apart > 0.0) line += fmt::format(" --stereo --eyes-apart {}", command.eyes_apart);
  if (command.point_size.world > 0.0) line += fmt::format(" --splat-size {}", command.point_size.world);
  if (command.colors.ramp != Ramp::viridis) line += fmt::format(" --ramp {}", name_of(command.colors.ramp));
  if (command.colors.hidden.any()) line += fmt::format(" --hide-class {}", stipple::text_of(command.colors.hidden));
  if (command.shading)
    line += fmt::format(" --edl --edl-strength {} --edl-radius {}", command.shading->strength, command.shading->radius);
  return line;
}

}  // namespace stipple
