#include "src/command/scene.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "octree/core/stopwatch.h"
#include "octree/read/las/las_writer.h"
#include "src/cli/cli.h"
#include "src/json/json.h"
#include "src/scene/scene.h"

namespace stipple {
namespace {

struct SceneArguments {
  std::string name;
  std::string output;
  std::string points = "10M";
  std::uint64_t seed = 1;
  bool json = false;
};

void run(const SceneArguments& options) {
  const auto scene = make_scene(options.name, parse_count("--points", options.points), options.seed);
  const Stopwatch watch;
  write_las(*scene, options.output);
  const double seconds = watch.seconds();

  const std::uint64_t points = scene->info().point_count;
  const std::uint64_t bytes = std::filesystem::file_size(options.output);
  const double rate = static_cast<double>(points) / seconds;
  if (options.json) {
    print_json({{"scene", options.name},
                {"path", options.output},
                {"points", points},
                {"seed", options.seed},
                {"bytes", bytes},
                {"seconds", seconds},
                {"points_per_second", rate}});
    return;
  }
  fmt::print("{}: {} points of scene {}, {} bytes, in {:.2f} s ({:.1f} M points/s)\n", options.output,
             with_thousands(points), options.name, with_thousands(bytes), seconds, rate * 1e-6);
}

std::string scenes_and_example() {
  std::string text = "The same name, number of points and seed give the same points on any machine.\n\nScenes:\n";
  for (const std::string& name : scene_names()) text += fmt::format("  {:<12}{}\n", name, describe_scene(name));
  return text + "\nExample:\n  stipple scene city -o city.las --points 20M --seed 7";
}

}  // namespace

void add_scene_command(CLI::App& app) {
  const auto options = std::make_shared<SceneArguments>();
  CLI::App* command = app.add_subcommand("scene", "Write a generated test scene as a LAS file.");
  command->add_option("NAME", options->name, "Scene, one of those below.")->required();
  command->add_option("-o,--output", options->output, "LAS file to write; an older one is replaced.")->required();
  command
      ->add_option("--points", options->points,
                   "Number of points, plain or with k, M or G for thousands, millions or billions.")
      ->capture_default_str();
  command->add_option("--seed", options->seed, "Seed of everything random, a whole number from 0.")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  add_json_flag(*command, options->json);
  command->footer(scenes_and_example());
  command->callback([options] { run(*options); });
}

}  // namespace stipple
