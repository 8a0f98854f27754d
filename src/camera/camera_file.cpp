#include "src/camera/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <set>

#include "octree/core/error.h"

namespace stipple {
namespace {

// A part of the file, for messages: "view 2", "path 1, camera 3".
struct Place {
  const std::string& file;
  std::string part;

  Error error(const std::string& what) const { return Error(fmt::format("{}: {}: {}", file, part, what)); }
};

glm::dvec3 vector_of(const Json& view, const char* key, const glm::dvec3* otherwise, const Place& place) {
  if (!view.contains(key)) {
    if (otherwise) return *otherwise;
    throw place.error(fmt::format("\"{}\" is missing; it is [x, y, z] in world coordinates", key));
  }
  const Json& value = view[key];
  if (!value.is_array() || value.size() != 3 || !value[0].is_number() || !value[1].is_number() || !value[2].is_number())
    throw place.error(fmt::format("\"{}\" is {}; expected three numbers [x, y, z]", key, value.dump()));
  return {value[0].get<double>(), value[1].get<double>(), value[2].get<double>()};
}

Camera camera_of(const Json& view, const Place& place) {
  Camera camera;
  camera.eye = vector_of(view, "eye", nullptr, place);
  camera.target = vector_of(view, "target", nullptr, place);
  const glm::dvec3 up = camera.up;
  camera.up = vector_of(view, "up", &up, place);
  if (view.contains("fov_deg")) {
    if (!view["fov_deg"].is_number()) throw place.error("\"fov_deg\" must be a number, in degrees");
    camera.fov_deg = view["fov_deg"].get<double>();
  }
  return camera;
}

// The name it has, or `otherwise`. Names become folders.
std::string name_of(const Json& object, const std::string& otherwise, const Place& place) {
  if (!object.contains("name")) return otherwise;
  if (!object["name"].is_string() || object["name"].get<std::string>().empty())
    throw place.error("\"name\" must be a text");
  std::string name = object["name"].get<std::string>();
  const bool control = std::ranges::any_of(name, [](unsigned char c) { return c < 0x20; });
  if (name.find('/') != std::string::npos || name[0] == '.' || control)
    throw place.error(fmt::format("the name {} cannot be the name of a folder", object["name"].dump()));
  return name;
}

NamedCamera view_of(const Json& view, std::size_t i, const Place& place) {
  if (!view.is_object()) throw place.error("expected an object with \"eye\" and \"target\"");
  return {name_of(view, fmt::format("view-{}", i + 1), place), camera_of(view, place)};
}

TimedCamera timed_camera_of(const Json& camera, const Place& place) {
  if (!camera.is_object()) throw place.error("expected an object with \"time\", \"eye\" and \"target\"");
  if (!camera.contains("time") || !camera["time"].is_number())
    throw place.error("\"time\" is missing or no number; it is in seconds");
  return {camera["time"].get<double>(), camera_of(camera, place)};
}

CameraPath path_of(const Json& path, std::size_t i, const Place& place) {
  if (!path.is_object() || !path.contains("cameras") || !path["cameras"].is_array() || path["cameras"].empty())
    throw place.error("expected an object with a list of \"cameras\"");
  CameraPath result{name_of(path, fmt::format("path-{}", i + 1), place), {}};
  for (const Json& camera : path["cameras"]) {
    const Place here{place.file, fmt::format("{}, camera {}", place.part, result.keys.size() + 1)};
    const TimedCamera key = timed_camera_of(camera, here);
    if (!result.keys.empty() && !(key.seconds > result.keys.back().seconds))
      throw here.error(fmt::format("\"time\" is {}; expected more than the {} of the camera before it", key.seconds,
                                   result.keys.back().seconds));
    result.keys.push_back(key);
  }
  return result;
}

// Every item of a list, which must have names of their own.
template <class Item, class Convert>
std::vector<Item> items_of(const Json& list, const char* kind, const std::string& file, const Convert& convert) {
  if (!list.is_array() || list.empty())
    throw Error(fmt::format("{}: expected an object with \"eye\" and \"target\", or a list of {}s as \"{}s\"", file,
                            kind, kind));
  std::vector<Item> items;
  std::set<std::string> names;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const Place place{file, fmt::format("{} {}", kind, i + 1)};
    items.push_back(convert(list[i], i, place));
    if (!names.insert(items.back().name).second)
      throw place.error(fmt::format("a {} called \"{}\" is there already", kind, items.back().name));
  }
  return items;
}

Json read_json(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw system_error(path, "cannot be opened");
  try {
    return Json::parse(file);
  } catch (const Json::parse_error& e) {
    throw file_error(path, e.byte, fmt::format("is no JSON: {}", e.what()));
  } catch (const Json::exception& e) {
    throw Error(fmt::format("{}: cannot be taken as JSON: {}", path, e.what()));
  }
}

}  // namespace

CameraFile read_camera_file(const std::string& path) {
  const Json document = read_json(path);
  CameraFile file;
  const bool views = document.is_object() && document.contains("views");
  const bool paths = document.is_object() && document.contains("paths");
  if (views || !paths)
    file.views = items_of<NamedCamera>(views ? document["views"] : Json::array({document}), "view", path, view_of);
  if (paths) file.paths = items_of<CameraPath>(document["paths"], "path", path, path_of);
  return file;
}

std::vector<NamedCamera> read_cameras(const std::string& path) {
  CameraFile file = read_camera_file(path);
  if (file.views.empty()) throw Error(fmt::format("{}: holds paths alone; expected \"views\"", path));
  return std::move(file.views);
}

std::vector<CameraPath> read_paths(const std::string& path) {
  CameraFile file = read_camera_file(path);
  if (file.paths.empty())
    throw Error(
        fmt::format("{}: holds views alone; expected \"paths\", each with a list of \"cameras\" that have a "
                    "\"time\" in seconds",
                    path));
  return std::move(file.paths);
}

Json json_of(const NamedCamera& named) {
  return {{"name", named.name},
          {"eye", json_of(named.camera.eye)},
          {"target", json_of(named.camera.target)},
          {"up", json_of(named.camera.up)},
          {"fov_deg", named.camera.fov_deg}};
}

Json json_of(const CameraPath& path) {
  Json cameras = Json::array();
  for (const TimedCamera& key : path.keys) {
    Json camera{{"time", key.seconds}};
    camera.update(json_of(NamedCamera{{}, key.camera}));
    camera.erase("name");
    cameras.push_back(camera);
  }
  return {{"name", path.name}, {"cameras", cameras}};
}

}  // namespace stipple
