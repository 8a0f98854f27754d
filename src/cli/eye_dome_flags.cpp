#include "src/cli/eye_dome_flags.h"

#include "src/cli/cli.h"

namespace stipple {

void add_eye_dome_flags(CLI::App& command, EyeDomeFlags& flags) {
  CLI::Option* on = command.add_flag("--edl", flags.on,
                                     "Shade by eye-dome lighting (Boucheny 2009): what is behind its neighbours in the "
                                     "picture gets darker. A pass over what was drawn; the points stay as they are.");
  command.add_option("--edl-strength", flags.strength, "How dark: above 0, and 1 is strong.")
      ->needs(on)
      ->capture_default_str();
  command.add_option("--edl-radius", flags.radius, "How far away neighbours are, in pixels.")
      ->needs(on)
      ->capture_default_str();
}

EyeDomeOptions eye_dome_options_of(const EyeDomeFlags& flags) {
  return {.strength = parse_positive("--edl-strength", flags.strength),
          .radius = parse_positive("--edl-radius", flags.radius)};
}

Json json_of(const std::optional<EyeDomeOptions>& shading) {
  if (!shading) return nullptr;
  return {{"strength", shading->strength}, {"radius", shading->radius}};
}

}  // namespace stipple
