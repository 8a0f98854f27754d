#include "src/study/ledger.h"

#include <fmt/format.h>

#include <filesystem>

#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "src/run/provenance.h"

namespace stipple {
namespace {

// Where two settings differ first, as "KEY is A, was B".
std::string difference(const Json& now, const Json& before) {
  for (const auto& [key, value] : now.items()) {
    const Json old = before.contains(key) ? before[key] : Json();
    if (old != value) return fmt::format("{} is {}, was {}", key, text_of(value), text_of(old));
  }
  return "some are gone";
}

std::string line_of(const Json& json) {
  return text_of(json) + '\n';
}

}  // namespace

Ledger::Ledger(const std::string& path, const Json& settings, bool resume) : path_(path) {
  // What json holds once it has been text
  const Json now = Json::parse(text_of(settings));
  if (resume && std::filesystem::exists(path)) read(now);
  // Whole, without the line that was cut short, or not at all
  std::string text = line_of({{"settings", now}});
  for (const auto& [key, value] : finished_) text += line_of({{"key", key}, {"value", value}});
  write_file(path, text);
  file_.open(path, std::ios::binary | std::ios::app);
  if (!file_) throw system_error(path, "cannot be written");
}

void Ledger::read(const Json& settings) {
  std::ifstream file(path_, std::ios::binary);
  if (!file) throw system_error(path_, "cannot be opened");
  std::string line;
  for (std::size_t number = 1; std::getline(file, line); ++number) {
    const Json json = Json::parse(line, nullptr, false);
    if (json.is_discarded() && file.eof()) break;  // cut short
    if (!json.is_object() || !json.contains(number == 1 ? "settings" : "value") ||
        (number > 1 && !(json.contains("key") && json["key"].is_string())))
      throw Error(fmt::format("{}: line {}: is not what a study writes there; leave out --resume to begin anew", path_,
                              number));
    if (number > 1)
      finished_[json["key"]] = json["value"];
    else if (json["settings"] != settings)
      throw Error(fmt::format("{}: was begun with other settings: {}; leave out --resume to begin anew", path_,
                              difference(settings, json["settings"])));
  }
}

const Json* Ledger::find(const std::string& key) const {
  const auto found = finished_.find(key);
  return found == finished_.end() ? nullptr : &found->second;
}

void Ledger::put(const std::string& key, const Json& value) {
  file_ << line_of({{"key", key}, {"value", value}}) << std::flush;
  if (!file_) throw system_error(path_, "cannot be written");
  finished_[key] = value;
}

}  // namespace stipple
