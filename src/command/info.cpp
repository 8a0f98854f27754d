#include "src/command/info.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <vector>

#include "octree/open/open.h"
#include "octree/store/open_tree.h"
#include "src/cli/cli.h"
#include "src/json/json.h"

namespace stipple {
namespace {

struct InfoArguments {
  std::vector<std::string> inputs;
  bool exact = false;
  bool json = false;
};

struct Level {
  std::uint64_t nodes = 0;
  std::uint64_t points = 0;
};

// What the whole hierarchy says, or the nodes themselves.
struct Nodes {
  std::vector<Level> levels;
  std::uint64_t count = 0;
  std::uint64_t points = 0;
  std::uint64_t bytes = 0;
  // World units cubed, of the boxes of all nodes with points: tight ones, where the tree knows them. Only if exact.
  std::optional<double> volume;
  std::optional<double> leaf_volume;  // of the leaves among them
};

double volume_of(const TreeStore& store, const StoredNode& node) {
  const TreeInfo& info = store.info();
  WorldBox box = node.box ? world_box(info.source.grid, *node.box) : cell_of(info.cube, node);
  if (info.has_details) box = world_box(info.source.grid, store.read_details(node).box);
  return (box.max.x - box.min.x) * (box.max.y - box.min.y) * (box.max.z - box.min.z);
}

Nodes nodes_of(const TreeStore& store, bool exact) {
  std::vector<StoredNode> hierarchy = read_whole_hierarchy(store);
  if (exact) hierarchy = locate_all(store, hierarchy);
  Nodes nodes;
  nodes.count = hierarchy.size();
  if (exact) nodes.volume = nodes.leaf_volume = 0.0;
  for (const StoredNode& node : hierarchy) {
    nodes.levels.resize(std::max<std::size_t>(nodes.levels.size(), node.level + 1));
    ++nodes.levels[node.level].nodes;
    nodes.levels[node.level].points += node.points;
    nodes.points += node.points;
    nodes.bytes += node.byte_size;
    if (!exact || node.points == 0) continue;
    const double volume = volume_of(store, node);
    *nodes.volume += volume;
    if (node.is_leaf()) *nodes.leaf_volume += volume;
  }
  return nodes;
}

// Empty for what is not a regular file.
std::optional<std::uint64_t> file_bytes(const std::string& path) {
  std::error_code error;
  const std::uintmax_t bytes = std::filesystem::file_size(path, error);
  if (error) return std::nullopt;
  return bytes;
}

// Of all files of the tree, as far as that is known without asking every node's.
std::optional<std::uint64_t> bytes_of(const TreeInfo& info, const Nodes& nodes, bool exact) {
  if (info.point_bytes) return *info.point_bytes + info.hierarchy_bytes.value_or(0);
  if (!info.node_files) return file_bytes(info.source.path);
  return exact ? std::optional(nodes.bytes) : std::nullopt;
}

std::optional<double> bytes_per_point(std::optional<std::uint64_t> bytes, std::uint64_t points) {
  if (!bytes || points == 0) return std::nullopt;
  return static_cast<double>(*bytes) / static_cast<double>(points);
}

template <class T>
Json json_or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

Json source_json(const SourceInfo& info, std::string_view points_from, std::optional<std::uint64_t> bytes) {
  Json attributes = Json::array();
  for (const Attribute& attribute : info.schema) attributes.push_back(json_of(attribute));
  return {{"path", info.path},
          {"format", info.format},
          {"version", info.version},
          {"encoding", info.encoding},
          {"points", info.point_count},
          {"points_from", points_from},
          {"dropped_points", info.dropped_points},
          {"file_bytes", json_or_null(bytes)},
          {"bytes_per_point", json_or_null(bytes_per_point(bytes, info.point_count))},
          {"grid", {{"scale", json_of(info.grid.scale)}, {"offset", json_of(info.grid.offset)}}},
          {"stated_bounds", json_of(info.stated_bounds)},
          {"attributes", attributes},
          {"warnings", info.warnings}};
}

Json tree_json(const TreeInfo& info, const Nodes& nodes) {
  Json json_levels = Json::array();
  for (const Level& level : nodes.levels) json_levels.push_back({{"nodes", level.nodes}, {"points", level.points}});
  return {{"nodes", nodes.count},
          {"depth", nodes.levels.empty() ? Json(nullptr) : Json(nodes.levels.size() - 1)},
          {"spacing", info.spacing},
          {"bounding_volume", json_or_null(nodes.volume)},
          {"leaf_bounding_volume", json_or_null(nodes.leaf_volume)},
          {"cube", {{"min", json_of(info.cube.min)}, {"edge", info.cube.edge}}},
          {"point_bytes", json_or_null(info.point_bytes)},
          {"hierarchy_bytes", json_or_null(info.hierarchy_bytes)},
          {"minimal_distance", json_or_null(info.minimal_distance)},
          {"levels", json_levels}};
}

std::string triple_of(const glm::dvec3& v) {
  return fmt::format("{}  {}  {}", v.x, v.y, v.z);
}

void print_line(std::string_view label, std::string_view value) {
  fmt::print("{:<15}{}\n", label, value);
}

void print_as_text(const SourceInfo& info, std::optional<std::uint64_t> bytes) {
  print_line("path", info.path);
  print_line("format", info.version.empty() ? info.format : fmt::format("{} {}", info.format, info.version));
  print_line("encoding", info.encoding);
  print_line("points", with_thousands(info.point_count));
  if (info.dropped_points > 0)
    print_line("",
               fmt::format("{} more have no finite position and are left out", with_thousands(info.dropped_points)));
  if (bytes) print_line("file size", fmt::format("{} bytes", with_thousands(*bytes)));
  if (const auto each = bytes_per_point(bytes, info.point_count))
    print_line("", fmt::format("{:.2f} bytes a point, all included", *each));
  print_line("grid scale", triple_of(info.grid.scale));
  print_line("grid offset", triple_of(info.grid.offset));
  if (info.stated_bounds.empty()) {
    print_line("stated bounds", "none");
  } else {
    print_line("stated min", triple_of(info.stated_bounds.min));
    print_line("stated max", triple_of(info.stated_bounds.max));
  }
  std::string_view label = "attributes";
  for (const Attribute& attribute : info.schema) {
    const std::string count = attribute.components > 1 ? fmt::format(" x {}", attribute.components) : "";
    print_line(label, fmt::format("{:<20} {}{}", attribute.name, name_of(attribute.type), count));
    label = "";
  }
  if (info.schema.empty()) print_line(label, "none");
}

void print_as_text(const TreeInfo& info, const Nodes& nodes) {
  const std::vector<Level>& levels = nodes.levels;
  print_line("nodes", with_thousands(nodes.count));
  print_line("cube min", triple_of(info.cube.min));
  print_line("cube edge", fmt::format("{}", info.cube.edge));
  if (info.spacing > 0.0)
    print_line("spacing", fmt::format("{} in the root, half of it with every level", info.spacing));
  if (info.minimal_distance)
    print_line("", fmt::format("inner nodes promise {} of it between any two points", *info.minimal_distance));
  if (nodes.volume)
    print_line("volume", fmt::format("{:.6g} cubic units in the boxes of the nodes with points, {:.6g} in the leaves'",
                                     *nodes.volume, *nodes.leaf_volume));
  if (!levels.empty()) print_line("depth", fmt::format("{}", levels.size() - 1));
  for (std::size_t i = 0; i < levels.size(); ++i)
    print_line(fmt::format("level {}", i), fmt::format("{:>8} nodes {:>16} points", with_thousands(levels[i].nodes),
                                                       with_thousands(levels[i].points)));
}

void run_on_tree(const InfoArguments& options) {
  const auto store = open_tree(options.inputs.front());
  TreeInfo info = store->info();
  for (const std::string& warning : info.source.warnings) warn(fmt::format("{}: {}", info.source.path, warning));
  const Nodes nodes = nodes_of(*store, options.exact);
  if (options.exact && nodes.points != info.source.point_count)
    warn(fmt::format("{}: the metadata state {} points, and the nodes hold {}", info.source.path,
                     info.source.point_count, nodes.points));
  if (options.exact) info.source.point_count = nodes.points;
  const std::optional<std::uint64_t> bytes = bytes_of(info, nodes, options.exact);
  if (!options.json) {
    print_as_text(info.source, bytes);
    print_as_text(info, nodes);
    return;
  }
  const bool counted = options.exact || !info.states_points;
  Json document = source_json(info.source, counted ? "nodes" : "metadata", bytes);
  document["octree"] = tree_json(info, nodes);
  print_json(document);
}

void run_on_file(const InfoArguments& options) {
  const auto source = open_source(options.inputs);
  const SourceInfo& info = source->info();
  for (const std::string& warning : info.warnings) warn(fmt::format("{}: {}", info.path, warning));
  if (options.json)
    print_json(source_json(info, "file", file_bytes(info.path)));
  else
    print_as_text(info, file_bytes(info.path));
}

}  // namespace

void add_info_command(CLI::App& app) {
  const auto options = std::make_shared<InfoArguments>();
  CLI::App* command = app.add_subcommand("info", "Say what a point cloud file or an octree holds.");
  command
      ->add_option("INPUT", options->inputs,
                   "Point cloud files, folders of them, or an octree: a COPC file, its folder, or its metadata.json, "
                   "ept.json or cloud.js. Several are one cloud.")
      ->required();
  command->add_flag("--exact", options->exact,
                    "Of an octree, count the points that its nodes hold, from the headers and sizes of their files, "
                    "instead of stating what its metadata say, and sum up the volume of their boxes.");
  add_json_flag(*command, options->json);
  command->footer(
      "Prints the format, the number of points, the integer grid that positions lie on (scale and offset in the "
      "cloud's\n"
      "own units), the bounds that the header states, and the attributes with their types; of an octree also its "
      "cube,\n"
      "its spacing, and how many nodes and points each level has. What the input is, is found out by its content, not\n"
      "by its name. Of PLY, PCD, OBJ and text, which state neither grid nor bounds, the positions are read to find "
      "them.\n"
      "In JSON, what the input does not say is null, and points_from tells whether the number of points is that of "
      "the\n"
      "metadata, of the nodes (--exact, or metadata that state none) or of the file.\n\n"
      "Example:\n  stipple info autzen.las --json");
  command->callback([options] {
    options->inputs.size() == 1 && is_tree(options->inputs.front()) ? run_on_tree(*options) : run_on_file(*options);
  });
}

}  // namespace stipple
