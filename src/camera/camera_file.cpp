#include "src/camera/camera_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <set>

#include "octree/core/error.h"

namespace stipple {
namespace {

// A view of the file under its number, for messages.
struct Place {
  const std::string& path;
  std::size_t view;

  Error error(const std::string& what) const { return Error(fmt::format("{}: view {}: {}", path, view + 1, what)); }
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

NamedCamera camera_of(const Json& view, const Place& place) {
  if (!view.is_object()) throw place.error("expected an object with \"eye\" and \"target\"");
  NamedCamera named;
  Camera& camera = named.camera;
  named.name = fmt::format("view-{}", place.view + 1);
  if (view.contains("name")) {
    if (!view["name"].is_string() || view["name"].get<std::string>().empty())
      throw place.error("\"name\" must be a text");
    named.name = view["name"].get<std::string>();
  }
  // Names become folders
  const bool control = std::ranges::any_of(named.name, [](unsigned char c) { return c < 0x20; });
  if (named.name.find('/') != std::string::npos || named.name[0] == '.' || control)
    throw place.error(fmt::format("the name {} cannot be the name of a folder", view["name"].dump()));
  camera.eye = vector_of(view, "eye", nullptr, place);
  camera.target = vector_of(view, "target", nullptr, place);
  const glm::dvec3 up = camera.up;
  camera.up = vector_of(view, "up", &up, place);
  if (view.contains("fov_deg")) {
    if (!view["fov_deg"].is_number()) throw place.error("\"fov_deg\" must be a number, in degrees");
    camera.fov_deg = view["fov_deg"].get<double>();
  }
  return named;
}

}  // namespace

std::vector<NamedCamera> read_cameras(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw system_error(path, "cannot be opened");
  Json document;
  try {
    document = Json::parse(file);
  } catch (const Json::parse_error& e) {
    throw file_error(path, e.byte, fmt::format("is no JSON: {}", e.what()));
  } catch (const Json::exception& e) {
    throw Error(fmt::format("{}: cannot be taken as JSON: {}", path, e.what()));
  }
  const Json alone = Json::array({document});
  const Json& views = document.is_object() && document.contains("views") ? document["views"] : alone;
  if (!views.is_array() || views.empty())
    throw Error(
        fmt::format("{}: expected an object with \"eye\" and \"target\", or a list of them as \"views\"", path));
  std::vector<NamedCamera> cameras;
  std::set<std::string> names;
  for (std::size_t i = 0; i < views.size(); ++i) {
    cameras.push_back(camera_of(views[i], {path, i}));
    if (!names.insert(cameras.back().name).second)
      throw Place{path, i}.error(fmt::format("a view called \"{}\" is there already", cameras.back().name));
  }
  return cameras;
}

Json json_of(const NamedCamera& named) {
  return {{"name", named.name},
          {"eye", json_of(named.camera.eye)},
          {"target", json_of(named.camera.target)},
          {"up", json_of(named.camera.up)},
          {"fov_deg", named.camera.fov_deg}};
}

}  // namespace stipple
