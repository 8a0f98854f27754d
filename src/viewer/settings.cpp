#include "src/viewer/settings.h"

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "src/json/json.h"

namespace stipple {
namespace {

constexpr std::size_t kMostRecent = 10;

// XDG Base Directory Specification 0.8: what is no absolute path is ignored.
std::string in_base_folder(const char* variable, const char* below_home, const char* file) {
  std::filesystem::path base;
  const char* given = std::getenv(variable);
  const char* home = std::getenv("HOME");
  if (given && *given == '/')
    base = given;
  else if (home && *home == '/')
    base = std::filesystem::path(home) / below_home;
  else
    return {};
  return base / "stipple" / file;
}

Json document_at(const std::string& path) {
  std::ifstream file(path);
  return file ? Json::parse(file, nullptr, false) : Json();
}

double number_in(const Json& document, const char* key, double least, double most, double otherwise) {
  const auto entry = document.find(key);
  if (entry == document.end() || !entry->is_number()) return otherwise;
  return std::clamp(entry->get<double>(), least, most);
}

bool flag_in(const Json& document, const char* key, bool otherwise) {
  const auto entry = document.find(key);
  return entry != document.end() && entry->is_boolean() ? entry->get<bool>() : otherwise;
}

void write(const std::string& path, const Json& document) {
  if (path.empty()) return;
  std::error_code failed;
  std::filesystem::create_directories(std::filesystem::path(path).parent_path(), failed);
  write_file(path, document.dump(2, ' ', false, Json::error_handler_t::replace) + "\n");
}

}  // namespace

void remember(RecentInputs& recent, const std::vector<std::string>& inputs) {
  std::vector<std::string> absolute;
  for (const std::string& input : inputs) {
    std::error_code failed;
    const std::filesystem::path path = std::filesystem::absolute(input, failed);
    absolute.push_back(failed ? input : path.lexically_normal().string());
  }
  std::erase(recent, absolute);
  recent.insert(recent.begin(), absolute);
  if (recent.size() > kMostRecent) recent.resize(kMostRecent);
}

std::string settings_path() {
  return in_base_folder("XDG_CONFIG_HOME", ".config", "viewer.json");
}

std::string recent_path() {
  return in_base_folder("XDG_STATE_HOME", ".local/state", "recent.json");
}

ViewerSettings read_settings(const std::string& path) {
  ViewerSettings settings;
  const Json document = document_at(path);
  if (!document.is_object()) return settings;
  settings.background = static_cast<std::uint32_t>(number_in(document, "background", 0, 0xFFFFFF, settings.background));
  settings.point_size = number_in(document, "point_size", 1, 10, settings.point_size);
  settings.frames_per_second = number_in(document, "frames_per_second", 5, 120, settings.frames_per_second);
  settings.eye_dome.strength = number_in(document, "edl_strength", 0.01, 10, settings.eye_dome.strength);
  settings.eye_dome.radius = number_in(document, "edl_radius", 1, 10, settings.eye_dome.radius);
  settings.shaded = flag_in(document, "edl", settings.shaded);
  settings.panel_shown = flag_in(document, "panel_shown", settings.panel_shown);
  return settings;
}

RecentInputs read_recent(const std::string& path) {
  RecentInputs recent;
  const Json document = document_at(path);
  if (!document.is_array()) return recent;
  for (const Json& inputs : document) {
    if (!inputs.is_array() || inputs.empty() || recent.size() == kMostRecent) continue;
    if (std::ranges::all_of(inputs, [](const Json& input) { return input.is_string(); }))
      recent.push_back(inputs.get<std::vector<std::string>>());
  }
  return recent;
}

void write_settings(const std::string& path, const ViewerSettings& settings) {
  write(path, {{"background", settings.background},
               {"point_size", settings.point_size},
               {"frames_per_second", settings.frames_per_second},
               {"edl", settings.shaded},
               {"edl_strength", settings.eye_dome.strength},
               {"edl_radius", settings.eye_dome.radius},
               {"panel_shown", settings.panel_shown}});
}

void write_recent(const std::string& path, const RecentInputs& recent) {
  write(path, Json(recent));
}

}  // namespace stipple
