#include "src/scene/scene.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "octree/core/error.h"
#include "src/scene/city.h"
#include "src/scene/corridor.h"
#include "src/scene/forest.h"
#include "src/scene/interior.h"
#include "src/scene/scene_source.h"
#include "src/scene/terrain.h"

namespace stipple {
namespace {

struct SceneEntry {
  std::string_view name;
  std::string_view description;
  std::unique_ptr<scene::SceneModel> (*make)(std::uint64_t points, std::uint64_t seed);
};

constexpr std::array kScenes{
    SceneEntry{
        "city",
        "A square kilometre of streets, trees and several hundred buildings with storeys inside; more than half of "
        "the points are hidden from outside.",
        scene::make_city},
    SceneEntry{
        "terrain",
        "Open country of 4 km x 4 km as an airborne scanner sees it: ridges, a river, fields; one surface, nearly "
        "nothing hidden.",
        scene::make_terrain},
    SceneEntry{"forest",
               "400 m x 400 m of woodland, several porous layers of leaves, branches and trunks over the ground.",
               scene::make_forest},
    SceneEntry{
        "interior",
        "A two-storey building from a dozen terrestrial scans: density falls with the square of the distance, with "
        "occlusion shadows and millimetres of range noise.",
        scene::make_interior},
    SceneEntry{
        "corridor",
        "A railway of 100 km surveyed 60 m wide: track, wires, masts, embankment and vegetation in UTM coordinates.",
        scene::make_corridor},
};

const SceneEntry& find_scene(std::string_view name) {
  const auto found = std::ranges::find(kScenes, name, &SceneEntry::name);
  if (found != kScenes.end()) return *found;
  std::string known;
  for (const SceneEntry& entry : kScenes) known += fmt::format("{}{}", known.empty() ? "" : ", ", entry.name);
  throw UsageError(fmt::format("there is no scene \"{}\"; the scenes are {}", name, known));
}

}  // namespace

std::vector<std::string> scene_names() {
  std::vector<std::string> names;
  for (const SceneEntry& entry : kScenes) names.emplace_back(entry.name);
  return names;
}

std::string describe_scene(std::string_view name) {
  return std::string(find_scene(name).description);
}

std::unique_ptr<PointSource> make_scene(const std::string& name, std::uint64_t points, std::uint64_t seed) {
  const SceneEntry& entry = find_scene(name);
  if (points > kMaxScenePoints)
    throw UsageError(
        fmt::format("{} points asked of scene \"{}\"; at most {} can be made", points, name, kMaxScenePoints));
  return std::make_unique<scene::SceneSource>(name, points, entry.make(points, seed));
}

}  // namespace stipple
