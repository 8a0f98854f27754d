#include "src/command/bench.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <sstream>
#include <string_view>
#include <vector>

#include "octree/core/error.h"
#include "octree/open/open.h"
#include "octree/read/las/las_writer.h"
#include "render/gpu/context.h"
#include "src/bench/compare.h"
#include "src/bench/parts.h"
#include "src/cli/cli.h"
#include "src/json/json.h"
#include "src/run/provenance.h"
#include "src/scene/scene.h"
#include "src/study/curve.h"

namespace stipple {
namespace {

struct BenchArguments {
  std::string input;
  std::vector<std::string> parts{"reading", "building", "processing", "drawing", "quality"};
  std::string points = "20M";
  std::string size = "1280x720";
  std::string budget = "1M";
  int repeats = 5;
  std::string compare;
  bool json = false;

  bool wants(std::string_view part) const { return std::ranges::find(parts, part) != parts.end(); }
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

BenchSettings settings_of(const BenchArguments& options) {
  BenchSettings settings;
  settings.size = parse_size("--size", options.size);
  settings.budget =
      static_cast<std::uint32_t>(std::min<std::uint64_t>(parse_count("--budget", options.budget), 0xFFFFFFFFu));
  settings.repeats = options.repeats;
  return settings;
}

Json read_bench(const std::string& path) {
  std::ifstream file(path);
  if (!file) throw Error(fmt::format("{}: cannot be read. Check the path.", path));
  Json document = Json::parse(file, nullptr, false);
  if (document.is_discarded())
    throw Error(fmt::format("{}: is not JSON; a document of `stipple bench --json` was expected.", path));
  return document;
}

void print_timing(const Timing& timing) {
  fmt::print("{:<40}{:>10.2f} ms{:>10.1f} M {}/s\n", timing.part, timing.median_ms(), timing.per_second() * 1e-6,
             timing.unit);
  if (!timing.remark.empty()) fmt::print("  {}\n", timing.remark);
  std::fflush(stdout);
}

void print_quality_head() {
  fmt::print("\nTime against error: points drawn and time to a quality, oblique view, from nothing\n{:<14}", "");
  for (const double db : kQualities) fmt::print("{:>21}", fmt::format("{:.0f} dB", db));
  fmt::print("{:>21}\n", "identical");
}

void print_quality(const QualityRow& row) {
  fmt::print("{:<14}", name_of(row.mode));
  for (const std::optional<Timing>& reached : row.reached)
    fmt::print("{:>21}",
               reached ? fmt::format("{:.2f} M {:.0f} ms", reached->amount * 1e-6, reached->median_ms()) : "-");
  fmt::print("\n");
  std::fflush(stdout);
}

Json as_json(const BenchComparison& comparison) {
  Json moved = Json::array();
  for (const Move& move : comparison.moved)
    moved.push_back({{"part", move.part}, {"old_ms", move.old_ms}, {"new_ms", move.new_ms}, {"ratio", move.ratio()}});
  Json points = Json::array();
  for (const PointsMove& move : comparison.other_points)
    points.push_back({{"part", move.part},
                      {"old_points", move.old_points},
                      {"new_points", move.new_points},
                      {"ratio", move.ratio()}});
  return {{"parts", comparison.compared},
          {"moved", moved},
          {"other_points", points},
          {"differences", comparison.differences}};
}

void print_comparison(const BenchComparison& comparison, const std::string& path) {
  fmt::print("\nAgainst {}: {} of {} parts moved beyond the noise\n", path, comparison.moved.size(),
             comparison.compared);
  for (const Move& move : comparison.moved)
    fmt::print("{:<40}{:>10.2f} ms{:>10.2f} ms{:>8.2f} x\n", move.part, move.old_ms, move.new_ms, move.ratio());
  if (!comparison.other_points.empty()) fmt::print("Other numbers of points drawn to a quality:\n");
  for (const PointsMove& move : comparison.other_points)
    fmt::print("{:<40}{:>10.2f} M {:>10.2f} M {:>8.2f} x\n", move.part, move.old_points * 1e-6, move.new_points * 1e-6,
               move.ratio());
  for (const std::string& difference : comparison.differences) warn(fmt::format("{}: {}", path, difference));
}

void run(const BenchArguments& options) {
  const BenchSettings settings = settings_of(options);
  const std::uint64_t points = parse_count("--points", options.points);
  std::optional<Json> old;
  if (!options.compare.empty()) old = read_bench(options.compare);

  std::unique_ptr<TemporaryScene> scene;
  if (options.input.empty()) scene = std::make_unique<TemporaryScene>(points);
  const auto source = open_source(scene ? scene->path() : options.input);
  const HeadlessContext context;

  Json parts = Json::array();
  if (!options.json)
    fmt::print("{} points, {}, {}; medians of {} runs\n\n", with_thousands(source->info().point_count), options.size,
               context.renderer(), settings.repeats);
  const TimingSink sink = [&](const Timing& timing) {
    parts.push_back(timing.json());
    if (!options.json) print_timing(timing);
  };
  // Builds bound what the whole process has resident: before the cloud is in memory
  if (options.wants("reading")) bench_reading(*source, settings, sink);
  if (options.wants("building")) bench_building(*source, settings, sink);
  Dataset dataset = load_dataset(*source, "", {});
  if (options.wants("processing")) bench_processing(dataset, settings, sink);
  if (options.wants("drawing")) bench_drawing(dataset, settings, sink);
  if (options.wants("quality")) {
    // It puts the points in another order: nothing else may come after
    add_octree(dataset);
    if (!options.json) print_quality_head();
    bench_quality(dataset, settings, [&](const QualityRow& row) {
      for (const std::optional<Timing>& reached : row.reached)
        if (reached) parts.push_back(reached->json());
      if (!options.json) print_quality(row);
    });
  }

  Json document = program_provenance();
  document.update(context_provenance(context));
  document["dataset"] = dataset_provenance(dataset);
  document["size"] = options.size;
  document["budget"] = settings.budget;
  document["repeats"] = settings.repeats;
  document["parts"] = parts;
  std::optional<BenchComparison> comparison;
  if (old) comparison = compare_benches(*old, document, options.compare);
  if (comparison) document["comparison"] = as_json(*comparison);
  if (options.json) return print_json(document);
  if (comparison) print_comparison(*comparison, options.compare);
}

}  // namespace

void add_bench_command(CLI::App& app) {
  const auto options = std::make_shared<BenchArguments>();
  CLI::App* command = app.add_subcommand("bench", "Time the parts of the program one by one.");
  CLI::Option* input =
      command->add_option("INPUT", options->input, "Point cloud to work on. Default: a generated city.");
  command
      ->add_option("--points", options->points,
                   "Points of the generated city, plain or with k, M or G for thousands, millions or billions.")
      ->excludes(input)
      ->capture_default_str();
  command
      ->add_option(
          "--parts", options->parts,
          "What to time, separated by commas: reading; building trees on disk; processing in memory; drawing; "
          "quality: points and time that each method takes to 30, 35, 40 and 45 dB and to the picture of brute "
          "force.")
      ->delimiter(',')
      ->check(CLI::IsMember({"reading", "building", "processing", "drawing", "quality"}))
      ->capture_default_str();
  command->add_option("--size", options->size, "Width and height of the picture in pixels.")->capture_default_str();
  command->add_option("--budget", options->budget, "Points a progressive frame fills in.")->capture_default_str();
  command->add_option("--repeat", options->repeats, "Runs of each part that count; one more comes before them.")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_option(
      "--compare", options->compare,
      "What an earlier run printed with --json. Says which parts moved beyond the noise: every run now "
      "was faster, or every one slower, than all of then; and where a method now draws another number of "
      "points to a quality.");
  add_json_flag(*command, options->json);
  command->footer(
      "Reading from a warm cache; building octrees on disk (at most 3 runs) and in memory; the reference renderer; "
      "for\n"
      "each rasterizer brute force and the passes of a progressive frame whose predecessor has drawn half of the "
      "points.\n"
      "Times are medians. Then time against error, in one table: each method on the oblique view from nothing, held\n"
      "against the reference, measuring outside the clock (at most 3 runs).\n\n"
      "Example:\n  stipple bench --points 20M --json > old.json\n  stipple bench --points 20M --compare old.json");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
