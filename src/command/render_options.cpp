#include "src/command/render_options.h"

#include <fmt/format.h>

#include "octree/core/error.h"
#include "octree/store/open_tree.h"
#include "render/method/while_loading.h"
#include "src/cli/cli.h"
#include "src/run/view_run.h"

namespace stipple {

void add_render_options(CLI::App& command, RenderOptions& options) {
  command
      .add_option("INPUT", options.inputs,
                  "Point clouds to draw: files, folders of files, octrees; together one cloud.")
      ->required();
  command.add_option("-o,--output", options.output, "PNG file to write; settings and results travel in its text.")
      ->required();
  command
      .add_option(
          "--mode", options.mode,
          "Method: reference (all points, double precision, CPU), brute-force (all points each frame), "
          "hierarchical (Tredinnick and others 2016), unstructured (Schuetz and others 2019), hybrid (ours: clusters "
          "by what the last frame shows), lod (octree nodes by the distance of their points on the screen, as "
          "many as the budget holds, drawn anew each frame) or subsample (a random subset for a new view, "
          "more of it while the view stands still).")
      ->capture_default_str();
  add_draw_options(command, options.draw);
  add_steer_option(command, options.draw);
  CLI::Option* camera =
      command.add_option("--camera", options.camera,
                         R"(JSON file with "eye" and "target", and optionally "up" and "fov_deg"; or with such )"
                         R"(objects as "views", or as "cameras" with a "time" in "paths".)");
  command.add_option("--view", options.view, "Which view or path of that file, by its name, where it has several.")
      ->needs(camera);
  command.add_option("--time", options.time, "Seconds on the time of a path in that file: where it is then.")
      ->needs(camera);
  CLI::Option* eye = command.add_option("--eye", options.eye, "Place of the eye as x,y,z in world coordinates.");
  CLI::Option* target = command.add_option("--target", options.target, "Place the eye looks at, as x,y,z.");
  eye->needs(target)->excludes(camera);
  target->needs(eye)->excludes(camera);
  command.add_option("--up", options.up, "Direction that is up in the picture, as x,y,z.")
      ->needs(eye)
      ->capture_default_str();
  command.add_option("--fov", options.fov_deg, "Vertical field of view in degrees.")->needs(eye)->capture_default_str();
  add_color_flags(command, options.color);
  add_stereo_flags(command, options.stereo);
  add_eye_dome_flags(command, options.eye_dome);
  command
      .add_option("--until", options.until,
                  "When to stop: converged (nothing is left to draw), frame:N (after N frames) or ms:T (after T "
                  "milliseconds of drawing), whatever comes first.")
      ->capture_default_str();
  command.add_flag(
      "--while-loading", options.while_loading,
      "Draw from the first points on while the file is being read, as modes unstructured (as the papers do, --carry "
      "vertex or index) and hybrid (like unstructured, until its clusters are there) can. Times then count from the "
      "beginning of the reading. Colours of intensity, height and the like stretch over the first points read until "
      "all are; converged, the picture is that of all points, exactly. Not for octrees.");
  command.add_option("--stats", options.stats, "JSON file for what was drawn, how long it took, and all settings.");
  command.add_option("--position-out", options.position_out,
                     "NumPy file for the world coordinates of every pixel (height x width x 3 doubles, NaN where "
                     "no point is).");
  command.add_option("--depth-out", options.depth_out,
                     "NumPy file for the depth along the line of sight in world units (height x width floats, inf "
                     "where no point is).");
  add_json_flag(command, options.json);
}

void check_options(const RenderOptions& options, const std::optional<Mode>& mode) {
  if (!mode && options.mode != kReference)
    throw UsageError(fmt::format("--mode {}: expected reference, {}", options.mode, mode_names()));
  if (options.while_loading && !(mode && draws_while_loading(*mode)))
    throw UsageError(
        fmt::format("--while-loading: mode {} draws nothing before all points are there; expected --mode "
                    "unstructured or hybrid",
                    options.mode));
  if (options.while_loading && options.inputs.size() == 1 && is_tree(options.inputs.front()))
    throw UsageError(
        fmt::format("--while-loading: {} is an octree, which modes hybrid and hierarchical draw from disk "
                    "at once; leave the option out",
                    options.inputs.front()));
  rasterizer_of(options.draw);
  budget_of(options.draw);
  if (method_options_of(options.draw).steering && mode != Mode::unstructured)
    throw UsageError(
        fmt::format("--steer gpu: the budget of mode {} is the CPU's; expected --mode unstructured", options.mode));
  color_choice_of(options.draw.color, options.color);
  if (shading_of(options) && !mode)
    throw UsageError("--edl: the reference is drawn on the CPU, and this is a pass on the GPU; choose another --mode");
  parse_until(options.until);
}

std::optional<EyeDomeOptions> shading_of(const RenderOptions& options) {
  return options.eye_dome.on ? std::optional(eye_dome_options_of(options.eye_dome)) : std::nullopt;
}

}  // namespace stipple
