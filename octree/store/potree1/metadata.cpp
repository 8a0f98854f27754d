#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>

#include "octree/store/json_cube.h"
#include "octree/store/potree1/format.h"

namespace stipple::potree1 {
namespace {

constexpr std::uint64_t kMaxPoints = std::uint64_t{1} << 48;
constexpr int kLowestMinor = 4;  // before, positions were floats
constexpr int kHighestMinor = 8;

double edge_of(const WorldBox& cube) {
  const glm::dvec3 size = cube.max - cube.min;
  return std::max({size.x, size.y, size.z});
}

int parse_version(const JsonValue& json) {
  const std::string& text = json.text();
  int minor = -1;
  if (text.starts_with("1.")) std::from_chars(text.data() + 2, text.data() + text.size(), minor);
  if (minor < kLowestMinor || minor > kHighestMinor)
    throw json.error(
        fmt::format("\"{}\" was found, and 1.{} to 1.{} was expected.", text, kLowestMinor, kHighestMinor));
  return minor;
}

WorldBox parse_box(const JsonValue& json) {
  const WorldBox box{{json["lx"].number(), json["ly"].number(), json["lz"].number()},
                     {json["ux"].number(), json["uy"].number(), json["uz"].number()}};
  if (!glm::all(glm::lessThanEqual(box.min, box.max))) throw json.error("\"u\" was expected to be above \"l\".");
  return box;
}

WorldBox parse_cube(const JsonValue& json) {
  const WorldBox box = parse_box(json);
  check_cube(box, json);
  return box;
}

// ["r042", 1234]: the digits; they are the node's way from the root.
std::string parse_digits(const JsonValue& json) {
  const std::string& name = json.text();
  const bool right = name.starts_with('r') && name.size() <= static_cast<std::size_t>(kMaxStoredLevel) + 1 &&
                     name.find_first_not_of("01234567", 1) == std::string::npos;
  if (!right) throw json.error(fmt::format("\"{}\" was found, and r with digits 0 to 7 was expected.", name));
  return name.substr(1);
}

struct ShorterFirst {
  bool operator()(const std::string& a, const std::string& b) const {
    return a.size() != b.size() ? a.size() < b.size() : a < b;
  }
};

// 1.4 lists all nodes. Those between that it leaves out hold no points.
TreeStore::HierarchyPiece parse_hierarchy(const JsonValue& json) {
  std::map<std::string, std::uint64_t, ShorterFirst> counts;
  for (const JsonValue& element : json.elements()) {
    const std::vector<JsonValue> entry = element.elements(2);
    counts[parse_digits(entry[0])] = entry[1].whole(0, kMaxPoints);
  }
  for (auto entry = counts.rbegin(); entry != counts.rend(); ++entry)
    if (!entry->first.empty()) counts.try_emplace(entry->first.substr(0, entry->first.size() - 1), 0);
  TreeStore::HierarchyPiece piece;
  std::map<std::string, std::uint32_t> places;
  for (const auto& [digits, points] : counts) {
    const auto index = static_cast<std::uint32_t>(piece.nodes.size());
    places[digits] = index;
    if (digits.empty()) {
      piece.nodes.emplace_back();
    } else {
      const std::uint32_t parent = places.at(digits.substr(0, digits.size() - 1));
      const int child = digits.back() - '0';
      piece.nodes.push_back(child_of(piece.nodes[parent], parent, child));
      piece.nodes[parent].children[static_cast<std::size_t>(child)] = index;
    }
    piece.nodes.back().points = points;
  }
  return piece;
}

void parse_encoding(const JsonValue& json, Metadata& metadata) {
  if (!json.is_text()) {
    parse_attributes(json, metadata);
    return;
  }
  if (json.text() != "LAS" && json.text() != "LAZ")
    throw json.error(fmt::format("\"{}\" was found, and LAS, LAZ or a list of attributes was expected.", json.text()));
  metadata.encoding = json.text() == "LAS" ? Encoding::las : Encoding::laz;
}

}  // namespace

Metadata parse_metadata(const std::string& text, const std::string& path) {
  const auto document = parse_json(text, path);
  const JsonValue json(document, path);
  Metadata metadata;
  metadata.version_minor = parse_version(json["version"]);
  metadata.octree_folder = json["octreeDir"].text();
  if (const auto points = json.find("points")) metadata.points = points->whole(0, kMaxPoints);
  metadata.cube = parse_cube(json["boundingBox"]);
  if (const auto tight = json.find("tightBoundingBox")) metadata.tight = parse_box(*tight);
  metadata.spacing = json["spacing"].number();
  if (metadata.spacing < 0.0) throw json["spacing"].error("0 or more was expected.");
  metadata.scale = json["scale"].number();
  if (!(metadata.scale > 0.0)) throw json["scale"].error("a number above 0 was expected.");
  parse_encoding(json["pointAttributes"], metadata);
  if (const auto step = json.find("hierarchyStepSize"))
    metadata.step_size = static_cast<int>(step->whole(1, 1000));
  else
    metadata.hierarchy = parse_hierarchy(json["hierarchy"]);
  return metadata;
}

Grid grid_of(const WorldBox& cube, double scale, int depth) {
  constexpr double kMostSteps = 1 << 29;  // of the grid, along the cube's edge: points may be a little outside
  constexpr int kMostHalvings = 10;
  const double steps = edge_of(cube) / scale;
  const bool whole = std::abs(steps - std::round(steps)) < 1e-6 * std::max(1.0, steps);
  const double cells = std::ldexp(1.0, depth);
  int halvings = 0;
  while (halvings < kMostHalvings && std::ldexp(steps, halvings + 1) <= kMostSteps &&
         !(whole && std::fmod(std::ldexp(std::round(steps), halvings), cells) == 0.0))
    ++halvings;
  return {cube.min, glm::dvec3(std::ldexp(scale, -halvings))};
}

int depth_for_grid(const TreeStore::HierarchyPiece& first, const WorldBox& cube, double scale) {
  constexpr double kLeastCell = 100.0;
  if (!first.continued.empty())
    return std::max(0, static_cast<int>(std::floor(std::log2(std::max(edge_of(cube) / scale, 1.0) / kLeastCell))));
  return first.nodes.empty() ? 0 : first.nodes.back().level;
}

}  // namespace stipple::potree1
