#include "src/command/view.h"

#include <fmt/format.h>

#include <filesystem>
#include <memory>

#include "octree/core/error.h"
#include "src/camera/camera_file.h"
#include "src/cli/cli.h"
#include "src/cli/color_flags.h"
#include "src/cli/draw_options.h"
#include "src/cli/eye_dome_flags.h"
#include "src/run/free_memory.h"
#include "src/viewer/viewer.h"

namespace stipple {
namespace {

// Of the memory that is free: the rest is for the driver and the pictures.
constexpr double kShareOfMemory = 0.8;
constexpr const char* kFramesPerSecond = "30";

struct ViewArguments {
  std::vector<std::string> inputs;
  std::string mode;
  std::string camera;
  std::string screenshot;
  std::string screenshot_size;
  bool with_panels = false;
  bool exit_after_screenshot = false;
  DrawOptions draw;
  ColorFlags color;
  EyeDomeFlags eye_dome;
};

ViewerOptions viewer_options(const ViewArguments& options) {
  ViewerOptions viewer;
  viewer.inputs = options.inputs;
  viewer.color = color_choice_of(options.draw.color, options.color);
  if (!options.mode.empty()) {
    viewer.mode = mode_named(options.mode);
    if (!viewer.mode) throw UsageError(fmt::format("--mode {}: expected {}", options.mode, mode_names()));
  }
  viewer.method = method_options_of(options.draw);
  if (options.draw.memory.empty())
    viewer.method.limits.main = static_cast<std::uint64_t>(kShareOfMemory * static_cast<double>(free_memory()));
  viewer.rasterizer = rasterizer_of(options.draw);
  viewer.policy = budget_of(options.draw);
  viewer.point_size = point_size_of(options.draw);
  viewer.background = parse_color("--background", options.draw.background);
  viewer.shaded = options.eye_dome.on;
  viewer.eye_dome = eye_dome_options_of(options.eye_dome);
  if (!options.camera.empty()) {
    const CameraFile file = read_camera_file(options.camera);
    if (!file.views.empty()) viewer.camera = file.views.front().camera;
    if (!file.paths.empty()) viewer.path = file.paths.front();
  }
  viewer.screenshot = options.screenshot;
  if (!options.screenshot_size.empty())
    viewer.screenshot_size = parse_size("--screenshot-size", options.screenshot_size);
  viewer.with_panels = options.with_panels;
  viewer.exit_after_screenshot = options.exit_after_screenshot;
  if (options.exit_after_screenshot && options.inputs.empty())
    throw UsageError("--exit-after-screenshot: INPUT is missing, there is nothing to picture");
  return viewer;
}

// What the command line leaves open is as it was last time.
void take_settings(ViewerOptions& viewer, const CLI::App& command) {
  const ViewerSettings settings = read_settings(settings_path());
  const auto open = [&](const char* name) { return command.get_option(name)->count() == 0; };
  if (open("--background")) viewer.background = settings.background;
  if (open("--point-size")) viewer.point_size.pixels = settings.point_size;
  if (open("--fps") && open("--budget")) viewer.policy.frames_per_second = settings.frames_per_second;
  if (open("--edl")) viewer.shaded = settings.shaded;
  if (open("--edl-strength")) viewer.eye_dome.strength = settings.eye_dome.strength;
  if (open("--edl-radius")) viewer.eye_dome.radius = settings.eye_dome.radius;
  viewer.panel_shown = settings.panel_shown;
  viewer.recent = read_recent(recent_path());
}

void keep_settings(const Viewer& viewer) {
  try {
    write_settings(settings_path(), viewer.settings());
    write_recent(recent_path(), viewer.recent());
  } catch (const Error& e) {
    warn(e.what());
  }
}

void run(const ViewArguments& options, const CLI::App& command) {
  ViewerOptions settings = viewer_options(options);
  const glm::ivec2 size = parse_size("--size", options.draw.size);
  for (const std::string& input : options.inputs)
    if (!std::filesystem::exists(input)) throw Error(fmt::format("{}: there is no such file or folder", input));
  // What scripts picture depends on nothing but the command line
  if (!options.exit_after_screenshot) take_settings(settings, command);
  Window window({.size = size});
  Viewer viewer(window, settings);
  viewer.run();
  if (!options.exit_after_screenshot) keep_settings(viewer);
}

}  // namespace

void add_view_command(CLI::App& app) {
  const auto options = std::make_shared<ViewArguments>();
  CLI::App* command = app.add_subcommand("view", "Look at a point cloud in a window.");
  command->add_option("INPUT", options->inputs,
                      "Point clouds to open: files, folders of files, octrees; together one cloud. Without any, drop "
                      "them on the window.");
  command->add_option("--mode", options->mode,
                      "Method to begin with, as `stipple render` knows them but for reference. Default: hybrid.");
  add_draw_options(*command, options->draw);
  add_color_flags(*command, options->color);
  add_eye_dome_flags(*command, options->eye_dome);
  CLI::Option* budget = command->get_option("--budget");
  command->add_option("--camera", options->camera,
                      R"(JSON file with "eye" and "target" to begin with, or "paths", as `stipple study --path` takes )"
                      "them, to fly with T; of several the first.");
  CLI::Option* screenshot =
      command->add_option("--screenshot", options->screenshot,
                          "PNG file to write when nothing is left to draw: the picture without the panels.");
  CLI::Option* size = command
                          ->add_option("--screenshot-size", options->screenshot_size,
                                       "Width and height of that picture in pixels; default: those of the window.")
                          ->needs(screenshot);
  command->add_flag("--with-panels", options->with_panels, "Picture the panels, too.")
      ->needs(screenshot)
      ->excludes(size);
  command->add_flag("--exit-after-screenshot", options->exit_after_screenshot, "End then.")->needs(screenshot);
  command->footer(
      fmt::format("The window shows points while they are read. Press ? in it for the keys. Points a frame are steered "
                  "to {} frames a second unless --fps or --budget say otherwise, or what was chosen last time. Without "
                  "--memory, points may take four fifths of the memory that is free.\n\n"
                  "Example:\n  stipple view scan.laz",
                  kFramesPerSecond));
  command->callback([options, command, budget] {
    if (options->draw.fps.empty() && budget->count() == 0) options->draw.fps = kFramesPerSecond;
    run(*options, *command);
  });
}

}  // namespace stipple
