#include "src/command/check.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "octree/core/error.h"
#include "octree/store/open_tree.h"
#include "octree/store/tree_source.h"
#include "src/check/check_tree.h"
#include "src/check/compare_points.h"
#include "src/cli/cli.h"
#include "src/command/build_inputs.h"
#include "src/json/json.h"

namespace stipple {
namespace {

struct CheckArguments {
  std::string tree;
  std::vector<std::string> against;
  bool json = false;
};

struct Outcome {
  TreeReport tree;
  std::optional<Comparison> against;

  const std::optional<Defect>& defect() const { return tree.defect || !against ? tree.defect : against->defect; }
};

Json as_json(const LevelReport& level) {
  return {{"nodes", level.nodes},
          {"inner_nodes", level.inner_nodes},
          {"points", level.points},
          {"spacing", level.spacing},
          {"closest_pair", json_of_any(level.closest_pair)}};
}

Json as_json(const Comparison& comparison) {
  return {{"points", comparison.input_points},
          {"largest_rounding", comparison.largest_rounding},
          {"compared", comparison.compared},
          {"in_tree_only", comparison.in_tree_only},
          {"in_inputs_only", comparison.in_inputs_only}};
}

Json as_json(const std::optional<Defect>& defect) {
  if (!defect) return nullptr;
  return {{"node", defect->node.empty() ? Json(nullptr) : Json(defect->node)}, {"what", defect->what}};
}

void print_as_json(const TreeInfo& info, const Outcome& outcome) {
  Json levels = Json::array();
  for (const LevelReport& level : outcome.tree.levels) levels.push_back(as_json(level));
  print_json({{"path", info.source.path},
              {"ok", !outcome.defect()},
              {"defect", as_json(outcome.defect())},
              {"points", outcome.tree.points},
              {"nodes", outcome.tree.nodes},
              {"bytes", outcome.tree.point_bytes},
              {"minimal_distance", info.minimal_distance ? Json(*info.minimal_distance) : Json(nullptr)},
              {"levels", levels},
              {"against", outcome.against ? as_json(*outcome.against) : Json(nullptr)}});
}

// "0.70 of the spacing", "-" where there is no pair in an inner node.
std::string closest_of(const LevelReport& level) {
  if (!std::isfinite(level.closest_pair)) return "-";
  if (level.spacing <= 0.0) return fmt::format("{:.4g}", level.closest_pair);
  return fmt::format("{:.4g} = {:.2f} spacings", level.closest_pair, level.closest_pair / level.spacing);
}

void print_names(std::string_view label, const std::vector<std::string>& names) {
  if (!names.empty()) fmt::print("{:<15}{}\n", label, fmt::join(names, ", "));
}

void print_as_text(const TreeInfo& info, const Outcome& outcome) {
  fmt::print("{} points in {} nodes, {} bytes\n\n", with_thousands(outcome.tree.points),
             with_thousands(outcome.tree.nodes), with_thousands(outcome.tree.point_bytes));
  fmt::print("level      nodes           points      spacing   closest in an inner node\n");
  for (std::size_t i = 0; i < outcome.tree.levels.size(); ++i) {
    const LevelReport& level = outcome.tree.levels[i];
    fmt::print("{:>5} {:>10} {:>16} {:>12.4g}   {}\n", i, with_thousands(level.nodes), with_thousands(level.points),
               level.spacing, closest_of(level));
  }
  if (info.minimal_distance)
    fmt::print("\npromised: no two points of an inner node closer than {} spacings\n", *info.minimal_distance);
  if (outcome.against && !outcome.against->defect) {
    fmt::print("\nthe same {} points as the inputs; largest rounding {}\n",
               with_thousands(outcome.against->input_points), outcome.against->largest_rounding);
    print_names("compared", outcome.against->compared);
    print_names("in the tree", outcome.against->in_tree_only);
    print_names("in the inputs", outcome.against->in_inputs_only);
  }
}

Outcome check(const std::shared_ptr<const TreeStore>& store, const std::vector<std::string>& against) {
  const std::vector<std::unique_ptr<PointSource>> inputs = open_inputs(against);
  Outcome outcome{check_tree(*store), std::nullopt};
  // What cannot be read, or claims more points than there are, cannot be compared
  if (!inputs.empty() && !outcome.tree.defect) outcome.against = compare_points(TreeSource(store), inputs);
  return outcome;
}

void run(const CheckArguments& options) {
  const std::shared_ptr<const TreeStore> store = open_tree(options.tree);
  const Outcome outcome = check(store, options.against);
  if (options.json)
    print_as_json(store->info(), outcome);
  else
    print_as_text(store->info(), outcome);
  if (const auto& defect = outcome.defect())
    throw Error(defect->node.empty() ? fmt::format("{}: {}", options.tree, defect->what)
                                     : fmt::format("{}: node {}: {}", options.tree, defect->node, defect->what));
}

}  // namespace

void add_check_command(CLI::App& app) {
  const auto options = std::make_shared<CheckArguments>();
  CLI::App* command = app.add_subcommand("check", "Read an octree whole and hold it to what it says.");
  command->add_option("OCTREE", options->tree, "Folder of the octree, or its metadata.json.")->required();
  command->add_option(
      "--against", options->against,
      "Files, folders of files, or octrees whose points, together, the octree has to hold: each exactly as often, with "
      "the same position and attributes.");
  add_json_flag(*command, options->json);
  command->footer(
      "Checks that nodes and points are as many as stated, that the bytes of the nodes cover the file without gaps or\n"
      "overlaps, that every point is inside its node (give or take a grid step), that values are within the\n"
      "stated ranges, and that no two points of an inner node are closer than the octree promises, if it promises\n"
      "anything. Positions of --against are compared on the octree's grid, and the largest rounding is printed;\n"
      "attributes that only one side has are named and not compared. Exit code 1 when anything is wrong: the message\n"
      "names the first offending node and why.\n\n"
      "Example:\n  stipple check autzen --against autzen.las");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
