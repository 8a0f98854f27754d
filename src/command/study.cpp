#include "src/command/study.h"

#include <fmt/format.h>

#include <memory>

#include "octree/core/error.h"
#include "src/camera/camera_file.h"
#include "src/cli/cli.h"
#include "src/cli/draw_options.h"
#include "src/json/json.h"
#include "src/study/study.h"

namespace stipple {
namespace {

struct Options {
  std::vector<std::string> inputs;
  std::string output;
  std::vector<std::string> modes;
  std::string views;
  std::string duration = "120";
  int repeats = 1;
  DrawOptions draw;
  bool flip_every_frame = false;
  bool json = false;
};

std::vector<Mode> modes_of(const std::vector<std::string>& names) {
  std::vector<Mode> modes;
  for (const std::string& name : names) {
    const auto mode = mode_named(name);
    if (!mode) throw UsageError(fmt::format("--modes {}: expected some of {}", name, mode_names()));
    if (std::ranges::find(modes, *mode) == modes.end()) modes.push_back(*mode);
  }
  if (modes.empty()) modes.assign(all_modes().begin(), all_modes().end());
  return modes;
}

StudySettings settings_of(const Options& options) {
  StudySettings settings;
  settings.inputs = options.inputs;
  settings.folder = options.output;
  settings.modes = modes_of(options.modes);
  if (!options.views.empty()) settings.cameras = read_cameras(options.views);
  settings.size = parse_size("--size", options.draw.size);
  settings.raster = rasterizer_of(options.draw);
  settings.budget = budget_of(options.draw);
  settings.method = method_options_of(options.draw);
  settings.seconds = parse_positive("--duration", options.duration);
  settings.repeats = options.repeats;
  settings.point_size = parse_positive("--point-size", options.draw.point_size);
  settings.color = options.draw.color;
  settings.background = parse_color("--background", options.draw.background);
  settings.flip_every_frame = options.flip_every_frame;
  return settings;
}

// "4,500,000 | 310 ms", or a dash where a curve did not get there.
std::string reached_text(const Json& reached) {
  if (reached.is_null()) return "-";
  return fmt::format("{:.2f} M {:.0f} ms", reached["points"].get<double>() * 1e-6, reached["ms_median"].get<double>());
}

void print_table(const Json& document) {
  fmt::print("{:<22}{:<10}{:<14}{:>16}{:>16}{:>18}{:>12}\n", "dataset", "view", "mode", "30 dB", "40 dB",
             "equal to all", "final dB");
  for (const Json& row : document["summary"]) {
    const Json& db = row["psnr_db"];
    fmt::print("{:<22}{:<10}{:<14}{:>16}{:>16}{:>18}{:>12}\n", row["dataset"].get<std::string>(),
               row["view"].get<std::string>(), row["mode"].get<std::string>(), reached_text(row["reached"]["30_db"]),
               reached_text(row["reached"]["40_db"]), reached_text(row["reached"]["identical"]),
               db.is_string() ? db.get<std::string>() : fmt::format("{:.2f}", db.get<double>()));
  }
}

void run(const Options& options) {
  const StudySettings settings = settings_of(options);
  const HeadlessContext context;
  const StudyResult result =
      run_study(settings, context, [](const std::string& step) { fmt::print(stderr, "stipple: {}\n", step); });
  if (options.json) {
    print_json(result.document);
  } else {
    print_table(result.document);
    fmt::print("\n{0}/plot.svg  {0}/curves.csv  {0}/study.json  {0}/frames  {0}/reference\n", options.output);
  }
  if (result.failures.empty()) return;
  std::string all = fmt::format("{} of {} inputs failed:", result.failures.size(), options.inputs.size());
  for (const std::string& failure : result.failures) all += "\n  " + failure;
  throw Error(all);
}

}  // namespace

void add_study_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("study", "Compare methods: quality against points drawn and against time.");
  command->add_option("INPUT", options->inputs, "Point clouds, each studied by itself; a folder of files is one.")
      ->required();
  command->add_option("-o,--output", options->output, "Folder to write to; it is made where it is missing.")
      ->required();
  command->add_option("--modes", options->modes, "Methods, separated by commas: " + mode_names() + ". Default: all.")
      ->delimiter(',');
  command->add_option("--views", options->views,
                      R"(JSON file with cameras: {"views": [{"name", "eye", "target", "up", "fov_deg"}, ...]}. )"
                      "Default: three views proposed for each cloud.");
  add_draw_options(*command, options->draw);
  command->add_option("--duration", options->duration, "Seconds of drawing after which a curve ends, converged or not.")
      ->capture_default_str();
  command->add_option("--repeat", options->repeats, "How often each curve is drawn; times are given as medians.")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag(
      "--flip-every-frame", options->flip_every_frame,
      "Measure FLIP for every frame. Default: for the first, the first at 30, 35, 40 and 45 dB, and the last; "
      "it takes about a tenth of a second for 1280x720 on two cores, outside the clock.");
  add_json_flag(*command, options->json);
  command->footer(
      "Each method draws each view from nothing with a still camera, frame by frame until its picture equals brute\n"
      "force. Every frame is held against the reference picture (all points, double precision, on the CPU): PSNR, "
      "over\n"
      "all and over covered pixels, SSIM, FLIP; shares of pixels that are holes, show what lies behind (see-through), "
      "what\n"
      "does not belong there (ghosts) or another point of the same surface; error of depth. No measuring is inside "
      "the\n"
      "clock. Writes\n"
      "curves.csv (a line a frame), study.json (settings, machine, summary), plot.svg, frames/ and reference/ "
      "(PNG).\n\n"
      "Example:\n  stipple study city.las -o out --modes hierarchical,unstructured --budget 500k");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
