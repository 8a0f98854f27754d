#include "src/command/study.h"

#include <fmt/format.h>
#include <signal.h>

#include <algorithm>
#include <atomic>
#include <memory>

#include "octree/core/error.h"
#include "src/camera/camera_file.h"
#include "src/cli/cli.h"
#include "src/cli/draw_options.h"
#include "src/json/json.h"
#include "src/study/study.h"

namespace stipple {
namespace {

struct StudyArguments {
  std::vector<std::string> inputs;
  std::string output;
  std::vector<std::string> modes;
  std::vector<std::string> regimes{"cold", "path"};
  std::string clock = "wall";
  std::string views;
  std::string path;
  int path_frames = 25;
  std::string duration = "120";
  int repeats = 1;
  DrawOptions draw;
  bool flip_every_frame = false;
  bool resume = false;
  bool json = false;
};

std::atomic<bool> interrupted{false};

// While it lives, the first SIGINT or SIGTERM has the study end properly; the second ends the program.
class InterruptOnSignal {
 public:
  InterruptOnSignal() {
    struct sigaction action {};
    action.sa_handler = [](int) { interrupted = true; };
    action.sa_flags = static_cast<int>(SA_RESETHAND);
    sigaction(SIGINT, &action, &old_interrupt_);
    sigaction(SIGTERM, &action, &old_terminate_);
  }
  ~InterruptOnSignal() {
    sigaction(SIGINT, &old_interrupt_, nullptr);
    sigaction(SIGTERM, &old_terminate_, nullptr);
  }
  InterruptOnSignal(const InterruptOnSignal&) = delete;
  InterruptOnSignal& operator=(const InterruptOnSignal&) = delete;

 private:
  struct sigaction old_interrupt_ {};
  struct sigaction old_terminate_ {};
};

std::vector<Regime> regimes_of(const std::vector<std::string>& names) {
  std::vector<Regime> regimes;
  for (const std::string& name : names) {
    const auto regime = regime_named(name);
    if (!regime) throw UsageError(fmt::format("--regime {}: expected cold, jump, path, stop or loading", name));
    if (std::ranges::find(regimes, *regime) == regimes.end()) regimes.push_back(*regime);
  }
  return regimes;
}

StudyClock clock_of(const std::string& name) {
  if (name == "wall") return StudyClock::wall;
  if (name == "points") return StudyClock::points;
  throw UsageError(fmt::format("--clock {}: expected wall or points", name));
}

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

StudySettings settings_of(const StudyArguments& options) {
  StudySettings settings;
  settings.inputs = options.inputs;
  settings.folder = options.output;
  settings.modes = modes_of(options.modes);
  settings.regimes = regimes_of(options.regimes);
  settings.clock = clock_of(options.clock);
  if (!options.views.empty()) settings.cameras = read_cameras(options.views);
  if (!options.path.empty()) settings.paths = read_paths(options.path);
  if (settings.cameras.size() == 1 && std::ranges::find(settings.regimes, Regime::jump) != settings.regimes.end())
    throw UsageError(fmt::format("--regime jump: {} holds one view; a jump takes two", options.views));
  for (const Regime regime : settings.regimes)
    if (modes_under(regime, settings.modes).empty())
      throw UsageError(
          "--regime loading: of the modes, none that was chosen draws while points are read; unstructured "
          "and hybrid do");
  settings.path_frames = options.path_frames;
  settings.size = parse_size("--size", options.draw.size);
  settings.raster = rasterizer_of(options.draw);
  settings.budget = budget_of(options.draw);
  settings.method = method_options_of(options.draw);
  settings.seconds = parse_positive("--duration", options.duration);
  settings.repeats = options.repeats;
  settings.point_size = point_size_of(options.draw);
  settings.color = options.draw.color;
  settings.background = parse_color("--background", options.draw.background);
  settings.flip_every_frame = options.flip_every_frame;
  settings.resume = options.resume;
  if (settings.method.steering && std::ranges::find(settings.modes, Mode::unstructured) == settings.modes.end())
    throw UsageError("--steer gpu: of the modes, none that was chosen has a budget of the GPU's; unstructured does");
  if (settings.clock == StudyClock::points && settings.budget.frames_per_second)
    throw UsageError("--fps: steers by time, which --clock points does without; expected --budget");
  return settings;
}

// "4.50 M 310 ms", or a dash where a curve did not get there.
std::string reached_text(const Json& reached) {
  if (reached.is_null()) return "-";
  const double points = reached["points"].get<double>() * 1e-6;
  if (reached["ms_median"].is_null()) return fmt::format("{:.2f} M", points);
  return fmt::format("{:.2f} M {:.0f} ms", points, reached["ms_median"].get<double>());
}

std::string db_text(const Json& db) {
  return db.is_string() ? db.get<std::string>() : fmt::format("{:.2f}", db.get<double>());
}

// The part of a picture's error that has this cause.
std::string part_text(const Json& quality, const char* part) {
  const double mse = quality["mse"].get<double>();
  return mse > 0.0 ? fmt::format("{:.1f} %", 100.0 * quality[part].get<double>() / mse) : "-";
}

void print_still(const Json& summaries) {
  fmt::print("{:<22}{:<7}{:<10}{:<14}{:>16}{:>16}{:>18}{:>10}\n", "dataset", "regime", "view", "mode", "30 dB", "40 dB",
             "equal to all", "final dB");
  for (const Json& row : summaries) {
    if (row["regime"] == "path") continue;
    fmt::print("{:<22}{:<7}{:<10}{:<14}{:>16}{:>16}{:>18}{:>10}\n", row["dataset"].get<std::string>(),
               row["regime"].get<std::string>(), row["view"].get<std::string>(), row["mode"].get<std::string>(),
               reached_text(row["reached"]["30_db"]), reached_text(row["reached"]["40_db"]),
               reached_text(row["reached"]["identical"]), db_text(row["psnr_db"]));
  }
}

void print_moving(const Json& summaries) {
  fmt::print("{:<22}{:<12}{:<14}{:>9}{:>10}{:>10}{:>11}{:>12}{:>10}{:>10}\n", "dataset", "path", "mode", "mean dB",
             "P50 ms", "P95 ms", "over time", "selection", "carry", "flicker");
  for (const Json& row : summaries) {
    if (row["regime"] != "path") continue;
    const Json& times = row["frame_ms"];
    const auto ms = [&](const char* key) {
      return times.is_null() ? std::string("-") : fmt::format("{:.0f}", times[key].get<double>());
    };
    const Json& over = row["frames_over_target"];
    const Json& mean = row["mean"];
    fmt::print("{:<22}{:<12}{:<14}{:>9}{:>10}{:>10}{:>11}{:>12}{:>10}{:>10}\n", row["dataset"].get<std::string>(),
               row["view"].get<std::string>(), row["mode"].get<std::string>(), db_text(mean["psnr_db"]), ms("p50"),
               ms("p95"), over.is_null() ? "-" : fmt::format("{:.0f} %", 100.0 * over.get<double>()),
               part_text(mean, "mse_selection"), part_text(mean, "mse_carry"),
               mean["flicker"].is_null() ? "-" : fmt::format("{:.2f}", mean["flicker"].get<double>()));
  }
}

void print_tables(const Json& summaries) {
  const auto is_path = [](const Json& row) { return row["regime"] == "path"; };
  const auto paths = std::ranges::count_if(summaries, is_path);
  if (paths < static_cast<std::ptrdiff_t>(summaries.size())) print_still(summaries);
  if (paths > 0 && paths < static_cast<std::ptrdiff_t>(summaries.size())) fmt::print("\n");
  if (paths > 0) print_moving(summaries);
}

void run(const StudyArguments& options) {
  const StudySettings settings = settings_of(options);
  const HeadlessContext context;
  const InterruptOnSignal on_signal;
  const StudyResult result = run_study(
      settings, context, [](const std::string& step) { fmt::print(stderr, "stipple: {}\n", step); }, &interrupted);
  if (options.json) {
    print_json(result.document);
  } else {
    print_tables(result.document["summary"]);
    fmt::print("\n{0}/index.html  {0}/plot.svg  {0}/curves.csv  {0}/study.json  {0}/frames  {0}/reference\n",
               options.output);
  }
  if (result.interrupted)
    throw Error(fmt::format("interrupted; what was finished is in {}, and the same command with --resume goes on",
                            options.output));
  if (result.failures.empty()) return;
  std::string all = fmt::format("{} failed:", result.failures.size() == 1 ? "this" : "these");
  for (const std::string& failure : result.failures) all += "\n  " + failure;
  throw Error(all);
}

}  // namespace

void add_study_command(CLI::App& app) {
  const auto options = std::make_shared<StudyArguments>();
  CLI::App* command = app.add_subcommand("study", "Compare methods: quality against points drawn and against time.");
  command->add_option("INPUT", options->inputs, "Point clouds, each studied by itself; a folder of files is one.")
      ->required();
  command->add_option("-o,--output", options->output, "Folder to write to; it is made where it is missing.")
      ->required();
  command->add_option("--modes", options->modes, "Methods, separated by commas: " + mode_names() + ". Default: all.")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option(
          "--regime", options->regimes,
          "What the camera does, separated by commas: cold (a still view, from nothing), jump (a still view, "
          "after the view before it has converged; the last one for the first), path (a new place each "
          "frame), stop (a still view where a path ends), loading (a still view while the points are read once more, "
          "for modes unstructured and hybrid, from when reading begins; with --clock points they come from "
          "memory, as many a frame as it may draw).")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  command
      ->add_option("--clock", options->clock,
                   "wall (time, and points beside it) or points (points alone: two runs give the same curves.csv, to "
                   "the last digit).")
      ->capture_default_str();
  command->add_option("--views", options->views,
                      R"(JSON file with cameras: {"views": [{"name", "eye", "target", "up", "fov_deg"}, ...]}. )"
                      "Default: three views proposed for each cloud.");
  command->add_option("--path", options->path,
                      R"(JSON file with paths: {"paths": [{"name", "cameras": [{"time", "eye", "target", "up", )"
                      R"("fov_deg"}, ...]}, ...]}; it may be the one with the views. Default: one proposed for each )"
                      "cloud, from the first view towards the last.");
  command
      ->add_option("--path-frames", options->path_frames,
                   "Frames along a path, evenly spaced in its time; each frame shows the next place, however long the "
                   "one before took. A frame takes 18 bytes a pixel of memory.")
      ->check(CLI::Range(2, 10'000))
      ->capture_default_str();
  add_draw_options(*command, options->draw);
  add_steer_option(*command, options->draw);
  command
      ->add_option("--duration", options->duration,
                   "Seconds of drawing after which a curve of a still view ends, converged or not; with --clock points "
                   "there is no such end.")
      ->capture_default_str();
  command->add_option("--repeat", options->repeats, "How often each curve is drawn; times are given as medians.")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  command->add_flag(
      "--flip-every-frame", options->flip_every_frame,
      "Measure FLIP for every frame of still views, too. Default: for the first, the first at 30, 35, 40 and 45 dB, "
      "and the last; it takes about a tenth of a second for 1280x720 on two cores, outside the clock.");
  command->add_flag("--resume", options->resume,
                    "Go on with what the same command has finished before, in the same folder.");
  add_json_flag(*command, options->json);
  command->footer(
      "Each method draws each view, frame by frame until its picture equals brute force, and each path. Every frame "
      "is\n"
      "held against the reference picture (all points, double precision, on the CPU): PSNR, over all and over covered\n"
      "pixels, SSIM, FLIP; shares of pixels that are holes, show what lies behind (see-through), what does not belong\n"
      "there (ghosts) or another point of the same surface; error of depth; where the error comes from (rounding, "
      "points\n"
      "not yet drawn, points lost on the way from frame to frame); flicker. No measuring is inside the clock. Writes\n"
      "curves.csv (a line a frame), study.json (settings, machine, summary), plot.svg, frames/ and reference/ "
      "(PNG).\n\n"
      "Example:\n  stipple study city.las -o out --modes hierarchical,unstructured --budget 500k");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
