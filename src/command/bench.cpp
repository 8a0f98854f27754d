#include "src/command/bench.h"

#include <fmt/format.h>
#include <unistd.h>

#include <filesystem>
#include <memory>

#include "octree/core/error.h"
#include "octree/open/open.h"
#include "octree/read/las/las_writer.h"
#include "render/gpu/context.h"
#include "src/bench/parts.h"
#include "src/cli/cli.h"
#include "src/json/json.h"
#include "src/run/provenance.h"
#include "src/scene/scene.h"

namespace stipple {
namespace {

struct Options {
  std::string input;
  std::string points = "10M";
  std::string size = "1280x720";
  std::string budget = "1M";
  int repeats = 5;
  bool json = false;
};

// A generated city in the temporary folder, gone with the object.
class TemporaryScene {
 public:
  explicit TemporaryScene(std::uint64_t points)
      : path_(std::filesystem::temp_directory_path() / fmt::format("stipple-bench-{}.las", getpid())) {
    write_las(*make_scene("city", points, 1), path_);
  }
  ~TemporaryScene() {
    std::error_code ignored;
    std::filesystem::remove(path_, ignored);
  }
  TemporaryScene(const TemporaryScene&) = delete;
  TemporaryScene& operator=(const TemporaryScene&) = delete;
  std::string path() const { return path_; }

 private:
  std::filesystem::path path_;
};

void run(const Options& options) {
  BenchSettings settings;
  settings.size = parse_size("--size", options.size);
  settings.budget =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(parse_count("--budget", options.budget), 0xFFFFFFFFu));
  settings.repeats = options.repeats;
  const std::uint64_t points = parse_count("--points", options.points);

  std::unique_ptr<TemporaryScene> scene;
  if (options.input.empty()) scene = std::make_unique<TemporaryScene>(points);
  const auto source = open_source(scene ? scene->path() : options.input);
  const HeadlessContext context;

  Json parts = Json::array();
  const auto sink = [&](const Timing& timing) {
    parts.push_back(timing.json());
    if (options.json) return;
    fmt::print("{:<40}{:>10.2f} ms{:>10.1f} M {}/s\n", timing.part, timing.median_ms(), timing.per_second() * 1e-6,
               timing.unit);
    std::fflush(stdout);
  };
  if (!options.json)
    fmt::print("{} points, {}, {}; medians of {} runs\n\n", with_thousands(source->info().point_count), options.size,
               context.renderer(), settings.repeats);
  bench_reading(*source, settings, sink);
  const Dataset dataset = load_dataset(*source, "", false);
  bench_processing(dataset, settings, sink);
  bench_drawing(dataset, settings, sink);
  if (!options.json) return;

  Json document = program_provenance();
  document.update(context_provenance(context));
  document["dataset"] = dataset_provenance(dataset);
  document["size"] = options.size;
  document["budget"] = settings.budget;
  document["repeats"] = settings.repeats;
  document["parts"] = parts;
  print_json(document);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("bench", "Time the parts of the program one by one.");
  CLI::Option* input =
      command->add_option("INPUT", options->input, "Point cloud to work on. Default: a generated city.");
  command
      ->add_option("--points", options->points,
                   "Points of the generated city, plain or with k, M or G for thousands, millions or billions.")
      ->excludes(input)
      ->capture_default_str();
  command->add_option("--size", options->size, "Width and height of the picture in pixels.")->capture_default_str();
  command->add_option("--budget", options->budget, "Points a progressive frame fills in.")->capture_default_str();
  command->add_option("--repeat", options->repeats, "Runs of each part that count; one more comes before them.")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  add_json_flag(*command, options->json);
  command->footer(
      "Reading from a warm cache, building the octree, the reference renderer, and for each rasterizer brute force "
      "and\n"
      "the passes of a progressive frame whose predecessor has drawn half of the points. Times are medians.\n\n"
      "Example:\n  stipple bench --points 20M");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
