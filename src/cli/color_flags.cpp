#include "src/cli/color_flags.h"

#include <fmt/format.h>

#include <charconv>

#include "octree/core/error.h"

namespace stipple {
namespace {

std::size_t class_of(const std::string& text) {
  std::size_t value = ClassSet().size();
  const auto [end, failed] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failed != std::errc() || end != text.data() + text.size() || value >= ClassSet().size())
    throw UsageError(fmt::format("--hide-class {}: expected LAS classes, 0 to 255, separated by commas", text));
  return value;
}

}  // namespace

void add_color_flags(CLI::App& command, ColorFlags& flags) {
  command
      .add_option("--ramp", flags.ramp,
                  fmt::format("Colours of height and of attributes that are neither rgb nor intensity, from low to "
                              "high: {}.",
                              ramp_names()))
      ->capture_default_str();
  command
      .add_option("--hide-class", flags.hide,
                  "Points of these classes (attribute classification) are not drawn, as in 7,18 for noise.")
      ->delimiter(',');
}

ColorChoice color_choice_of(const std::string& attribute, const ColorFlags& flags) {
  const auto ramp = ramp_named(flags.ramp);
  if (!ramp) throw UsageError(fmt::format("--ramp {}: expected one of {}", flags.ramp, ramp_names()));
  ColorChoice choice(attribute, *ramp);
  for (const std::string& text : flags.hide) choice.hidden.set(class_of(text));
  return choice;
}

std::string text_of(const ClassSet& classes) {
  std::string text;
  for (std::size_t i = 0; i < classes.size(); ++i)
    if (classes[i]) text += fmt::format("{}{}", text.empty() ? "" : ",", i);
  return text;
}

Json color_provenance(const ColorMap& map) {
  Json hidden = Json::array();
  for (std::size_t i = 0; i < map.hidden.size(); ++i)
    if (map.hidden[i]) hidden.push_back(i);
  return {{"ramp", name_of(map.ramp)}, {"hidden_classes", hidden}};
}

}  // namespace stipple
