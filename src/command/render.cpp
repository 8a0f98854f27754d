#include "src/command/render.h"

#include <fmt/format.h>

#include <chrono>
#include <limits>
#include <memory>

#include "octree/core/error.h"
#include "octree/core/output_file.h"
#include "octree/open/open.h"
#include "octree/store/open_tree.h"
#include "render/frame/propose_views.h"
#include "render/gpu/context.h"
#include "render/measure/image.h"
#include "render/measure/npy.h"
#include "render/reference/reference.h"
#include "render/store/dataset.h"
#include "src/camera/camera_file.h"
#include "src/cli/cli.h"
#include "src/cli/color_flags.h"
#include "src/cli/draw_options.h"
#include "src/cli/eye_dome_flags.h"
#include "src/cli/stereo_flags.h"
#include "src/json/json.h"
#include "src/run/loading_run.h"
#include "src/run/peak_memory.h"
#include "src/run/provenance.h"
#include "src/run/view_run.h"

namespace stipple {
namespace {

constexpr const char* kReference = "reference";

struct Options {
  std::vector<std::string> inputs;
  std::string output;
  std::string mode = "hybrid";
  std::string camera;
  std::string view;
  std::optional<double> time;
  std::string eye;
  std::string target;
  std::string up = "0,0,1";
  double fov_deg = 60.0;
  std::string until = "converged";
  std::string stats;
  std::string position_out;
  std::string depth_out;
  bool while_loading = false;
  DrawOptions draw;
  ColorFlags color;
  EyeDomeFlags eye_dome;
  StereoFlags stereo;
  bool json = false;
};

// What was drawn and how.
struct Picture {
  FrameData frame;
  Json stats;
};

std::optional<EyeDomeOptions> shading_of(const Options& options) {
  return options.eye_dome.on ? std::optional(eye_dome_options_of(options.eye_dome)) : std::nullopt;
}

std::vector<std::uint32_t> shaded_colors(const FeedbackTarget& frame, const EyeDomeOptions& shading) {
  EyeDome eye_dome;
  return read_colors(eye_dome.shade(frame, shading));
}

FrameData read_picture(ProgressiveRenderer& renderer, const View& view, const std::optional<EyeDomeOptions>& shading) {
  std::vector<FrameData> frames;
  for (std::size_t eye = 0; eye < view.eyes(); ++eye) {
    frames.push_back(renderer.read(eye));
    if (shading) frames.back().rgba = shaded_colors(*renderer.frame(eye), *shading);
  }
  return side_by_side(std::move(frames));
}

// The one called --view, or the only one there is.
template <class Named>
const Named& chosen(const std::vector<Named>& all, const Options& options, const char* kind) {
  if (options.view.empty()) {
    if (all.size() > 1)
      throw UsageError(fmt::format("--camera {}: holds {} {}s; a picture is taken from one, which --view names",
                                   options.camera, all.size(), kind));
    return all.front();
  }
  const auto found = std::ranges::find(all, options.view, &Named::name);
  if (found == all.end())
    throw UsageError(fmt::format("--view {}: {} has no {} of that name", options.view, options.camera, kind));
  return *found;
}

// Null: one is to be proposed.
std::optional<Camera> camera_asked_for(const Options& options) {
  if (!options.camera.empty()) {
    if (options.time) return camera_at(chosen(read_paths(options.camera), options, "path"), *options.time);
    return chosen(read_cameras(options.camera), options, "view").camera;
  }
  if (options.eye.empty()) return std::nullopt;
  return Camera{.eye = parse_vector("--eye", options.eye),
                .target = parse_vector("--target", options.target),
                .up = parse_vector("--up", options.up),
                .fov_deg = options.fov_deg};
}

Camera proposed_camera(const PointSet& points, double aspect) {
  return propose_cameras(points, aspect).front().camera;
}

View view_asked_for(const Options& options, const Camera& camera, const glm::ivec2& size, const Grid& grid) {
  View view = make_view(camera, size, near_plane(grid));
  view.eyes_apart = eyes_apart_of(options.stereo, camera);
  return view;
}

Json json_of_eye(const View& view, const EyeState& state) {
  return {{"eye", json_of(view.eye)},
          {"points_reprojected", state.points_reprojected},
          {"covered_pixels", state.covered_pixels}};
}

// Null where there is one eye.
Json stereo_json(const View& view, const std::vector<EyeState>& eyes) {
  if (view.eyes() == 1) return nullptr;
  return {{"eyes_apart", view.eyes_apart},
          {"left", json_of_eye(view.of_eye(0), eyes[0])},
          {"right", json_of_eye(view.of_eye(1), eyes[1])}};
}

Picture draw_reference(const Dataset& dataset, const View& view, const PointSize& point_size) {
  const auto start = std::chrono::steady_clock::now();
  std::vector<FrameData> frames;
  std::vector<EyeState> eyes;
  for (std::size_t eye = 0; eye < view.eyes(); ++eye) {
    frames.push_back(render_reference(dataset.points, view.of_eye(eye), point_size));
    eyes.push_back({.covered_pixels = frames.back().covered_pixels()});
  }
  Picture picture{side_by_side(std::move(frames)), {}};
  const double ms = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  picture.stats = {{"views", view.eyes()},
                   {"points_drawn", dataset.points.size()},
                   {"points_reprojected", 0},
                   {"points_in_views", view.eyes() * dataset.points.size()},
                   {"frames", 1},
                   {"converged", true},
                   {"ms", ms},
                   {"covered_pixels", picture.frame.covered_pixels()},
                   {"stereo", stereo_json(view, eyes)},
                   {"nodes_visible", 0},
                   {"nodes_occluded", 0},
                   {"bytes_read", 0},
                   {"gl_renderer", nullptr}};
  return picture;
}

Json stats_of(const View& view, const FrameState& state, const SelectionCounts& counts) {
  return {{"views", view.eyes()},
          {"points_drawn", state.points_drawn},
          {"points_reprojected", state.points_reprojected},
          {"points_in_views", state.points_in_views()},
          {"frames", state.frame},
          {"converged", state.converged},
          {"ms", state.milliseconds},
          {"covered_pixels", state.covered_pixels},
          {"stereo", stereo_json(view, state.eyes)},
          {"nodes_visible", counts.nodes_visible},
          {"nodes_occluded", counts.nodes_occluded},
          {"pixels_estimated", counts.pixels_estimated},
          {"clusters_far", counts.clusters_far},
          {"clusters_near", counts.clusters_near},
          {"clusters_across", counts.clusters_across},
          {"bytes_read", counts.bytes_read}};
}

Picture draw_with_gl(const Options& options, Mode mode, const Dataset& dataset, const View& view,
                     const PointSize& point_size) {
  const BudgetPolicy policy = budget_of(options.draw);
  const HeadlessContext context;
  const auto method = make_method(mode, dataset, method_options_of(options.draw));
  ProgressiveRenderer renderer(*method, rasterizer_of(options.draw), dataset.points.grid, point_size);
  const FrameState state = run_view(renderer, view, policy, parse_until(options.until));
  Picture picture{read_picture(renderer, view, shading_of(options)), stats_of(view, state, method->counts())};
  picture.stats.update(context_provenance(context));
  return picture;
}

// The points of a picture that is drawn while they are read are not known when the camera is: what the header says of
// them is.
PointSet stated_corners(const SourceInfo& info) {
  if (info.stated_bounds.empty())
    throw UsageError(fmt::format(
        "--while-loading: {} does not say where its points are before they are read; give --eye or --camera",
        info.path));
  PointSet corners;
  corners.grid = info.grid;
  constexpr double kMost = std::numeric_limits<std::int32_t>::max();
  for (const glm::dvec3& corner : {info.stated_bounds.min, info.stated_bounds.max}) {
    const glm::dvec3 cell = glm::clamp((corner - info.grid.offset) / info.grid.scale, -kMost, kMost);
    corners.points.push_back({glm::ivec3(glm::round(cell)), 0});
    corners.bounds.extend(corners.points.back().position);
  }
  return corners;
}

Json loading_json(LoadingDrawing& drawing, const FrameState& last, Json frames) {
  const LoadingDrawing::Times& times = drawing.times();
  const auto json = [](const std::optional<double>& ms) { return ms ? Json(*ms) : Json(); };
  return {{"first_points_ms", json(times.first_points_ms)},
          {"loaded_ms", json(times.loaded_ms)},
          {"clusters_ms", json(times.clusters_ms)},
          {"converged_ms", last.converged ? Json(last.milliseconds) : Json()},
          {"points_loaded", drawing.loading().points_loaded()},
          {"bytes_uploaded", drawing.loading().bytes_uploaded()},
          {"color_bytes_uploaded", drawing.loading().color_bytes_uploaded()},
          {"frames", std::move(frames)}};
}

// What there is of the cloud when drawing ends: all of it, or what could be read.
struct LoadedPicture {
  Picture picture;
  std::shared_ptr<const Dataset> dataset;
};

LoadedPicture draw_while_loading(const Options& options, Mode mode, const PointSource& source, const View& view,
                                 const PointSize& point_size) {
  const HeadlessContext context;
  const Grid grid = source.info().grid;
  ColorChoice color = color_choice_of(options.draw.color, options.color);
  color.attribute = choose_color(source.info().schema, color.attribute);
  BackgroundLoad load(source, color);
  LoadingDrawing drawing(load, mode, method_options_of(options.draw), rasterizer_of(options.draw), grid, point_size,
                         budget_of(options.draw), view);
  const Until until = parse_until(options.until);
  Json frames = Json::array();
  FrameState state;
  do {
    state = drawing.draw(view);
    frames.push_back(
        {{"ms", state.milliseconds}, {"points_loaded", *state.points_loaded}, {"points_drawn", state.points_drawn}});
  } while (!ended(until, state));
  std::shared_ptr<const Dataset> dataset = drawing.loading().whole();
  if (!dataset) {
    auto part = std::make_shared<Dataset>();
    part->info = source.info();
    part->points.grid = grid;
    part->colors = color.complete({.attribute = color.attribute});
    dataset = std::move(part);
  }
  LoadedPicture drawn{
      {read_picture(drawing.renderer(), view, shading_of(options)), stats_of(view, state, drawing.loading().counts())},
      std::move(dataset)};
  drawn.picture.stats["while_loading"] = loading_json(drawing, state, std::move(frames));
  drawn.picture.stats.update(context_provenance(context));
  return drawn;
}

void write_arrays(const Options& options, const FrameData& frame, const Grid& grid) {
  const auto height = static_cast<std::size_t>(frame.size.y);
  const auto width = static_cast<std::size_t>(frame.size.x);
  if (!options.depth_out.empty()) write_npy(options.depth_out, std::span(frame.depth), {height, width});
  if (options.position_out.empty()) return;
  std::vector<double> positions(3 * frame.pixels(), std::numeric_limits<double>::quiet_NaN());
  for (std::size_t i = 0; i < frame.pixels(); ++i) {
    if (frame.ids[i] == kNoPoint) continue;
    const glm::dvec3 world = grid.world_from_grid(frame.positions[i]);
    for (int axis = 0; axis < 3; ++axis) positions[3 * i + static_cast<std::size_t>(axis)] = world[axis];
  }
  write_npy(options.position_out, std::span<const double>(positions), {height, width, 3});
}

// Points a frame: as asked for, or what the memory allows where all of them stream every frame.
std::uint32_t budget_in_use(const Options& options, const Dataset& dataset) {
  const std::uint32_t budget = budget_of(options.draw).points;
  const bool streams = options.mode == name_of(Mode::hierarchical) && !dataset.in_memory();
  return streams ? budget_within(limits_of(options.draw), budget) : budget;
}

// Everything but the camera that can be checked before points are read.
void check(const Options& options, const std::optional<Mode>& mode) {
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
  method_options_of(options.draw);
  color_choice_of(options.draw.color, options.color);
  if (shading_of(options) && !mode)
    throw UsageError("--edl: the reference is drawn on the CPU, and this is a pass on the GPU; choose another --mode");
  parse_until(options.until);
}

// Settings and results.
Json stats_of(const Options& options, const Picture& picture, const Dataset& dataset, const View& view) {
  const MethodOptions method = method_options_of(options.draw);
  const PointSize point_size = point_size_of(options.draw);
  const bool reference = options.mode == kReference;
  Json stats{{"mode", options.mode},
             {"raster", reference ? Json() : Json(options.draw.raster)},
             {"seed", options.draw.seed},
             {"carry", options.draw.carry},
             {"density", options.draw.density},
             {"budget", budget_in_use(options, dataset)},
             {"skip_occluded", method.skip_occluded},
             {"by_yield", method.by_yield},
             {"keep_still", method.keep_still},
             {"point_size", point_size.pixels},
             {"splat_size", point_size.world},
             {"background", options.draw.background},
             {"edl", json_of(shading_of(options))},
             {"load_ms", dataset.load_seconds * 1e3},
             {"build_ms", dataset.build_seconds * 1e3}};
  const auto fps = budget_of(options.draw).frames_per_second;
  stats["target_fps"] = fps ? Json(*fps) : Json();
  stats.update(picture.stats);
  stats.update(dataset_provenance(dataset));
  stats.update(color_provenance(dataset.colors));
  stats["view"] = view_provenance(view);
  stats.update(program_provenance());
  stats["peak_memory_bytes"] = peak_memory();
  return stats;
}

void print_summary(const Options& options, const Json& stats) {
  fmt::print("{}: {} of {} points drawn in {} frames, {:.1f} ms; {} pixels covered{}\n", options.output,
             with_thousands(stats["points_drawn"].get<std::uint64_t>()),
             with_thousands(stats["points_total"].get<std::uint64_t>()), stats["frames"].get<std::uint64_t>(),
             stats["ms"].get<double>(), with_thousands(stats["covered_pixels"].get<std::uint64_t>()),
             stats["converged"].get<bool>() ? ", converged" : "");
  if (!options.while_loading) return;
  const Json& loading = stats["while_loading"];
  const auto ms = [&](const char* key) {
    return loading[key].is_null() ? std::string("not") : fmt::format("after {:.0f} ms", loading[key].get<double>());
  };
  fmt::print("  first points seen {}, all loaded {}\n", ms("first_points_ms"), ms("loaded_ms"));
}

void write_results(const Options& options, const Picture& picture, const Dataset& dataset, const View& view) {
  const Json stats = stats_of(options, picture, dataset, view);
  write_png(options.output, compose(picture.frame, parse_color("--background", options.draw.background)),
            {{"stipple", text_of(stats)}});
  if (!options.stats.empty()) write_file(options.stats, text_of(stats, 2) + "\n");
  write_arrays(options, picture.frame, dataset.points.grid);
  if (options.json)
    print_json(stats);
  else
    print_summary(options, stats);
}

void run_while_loading(const Options& options, Mode mode, const glm::ivec2& size, const PointSize& point_size) {
  const auto source = open_source(options.inputs);
  const SourceInfo& info = source->info();
  for (const std::string& warning : info.warnings) warn(warning);
  check_memory(info, mode == Mode::hybrid, limits_of(options.draw));
  const auto asked = camera_asked_for(options);
  const Camera camera = asked ? *asked : proposed_camera(stated_corners(info), static_cast<double>(size.x) / size.y);
  const View view = view_asked_for(options, camera, size, info.grid);
  const LoadedPicture drawn = draw_while_loading(options, mode, *source, view, point_size);
  write_results(options, drawn.picture, *drawn.dataset, view);
}

void run(const Options& options) {
  const std::optional<Mode> mode = mode_named(options.mode);
  const glm::ivec2 size = parse_size("--size", options.draw.size);
  const PointSize point_size = point_size_of(options.draw);
  parse_color("--background", options.draw.background);
  check(options.stereo, size);
  check(options, mode);
  if (options.while_loading) return run_while_loading(options, *mode, size, point_size);

  const Dataset dataset = open_dataset(options.inputs, color_choice_of(options.draw.color, options.color),
                                       mode ? needs_of(*mode) : DatasetNeeds{}, limits_of(options.draw));
  for (const std::string& warning : dataset.info.warnings) warn(warning);
  const auto asked = camera_asked_for(options);
  const Camera camera = asked ? *asked : proposed_camera(dataset.overview(), static_cast<double>(size.x) / size.y);
  const View view = view_asked_for(options, camera, size, dataset.points.grid);
  const Picture picture =
      mode ? draw_with_gl(options, *mode, dataset, view, point_size) : draw_reference(dataset, view, point_size);
  write_results(options, picture, dataset, view);
}

}  // namespace

void add_render_command(CLI::App& app) {
  const auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("render", "Draw one picture of a point cloud.");
  command
      ->add_option("INPUT", options->inputs,
                   "Point clouds to draw: files, folders of files, octrees; together one cloud.")
      ->required();
  command->add_option("-o,--output", options->output, "PNG file to write; settings and results travel in its text.")
      ->required();
  command
      ->add_option(
          "--mode", options->mode,
          "Method: reference (all points, double precision, CPU), brute-force (all points each frame), "
          "hierarchical (Tredinnick and others 2016), unstructured (Schuetz and others 2019), hybrid (ours: clusters "
          "by what the last frame shows), lod (octree nodes by the distance of their points on the screen, as "
          "many as the budget holds, drawn anew each frame) or subsample (a random subset for a new view, "
          "more of it while the view stands still).")
      ->capture_default_str();
  add_draw_options(*command, options->draw);
  CLI::Option* camera =
      command->add_option("--camera", options->camera,
                          R"(JSON file with "eye" and "target", and optionally "up" and "fov_deg"; or with such )"
                          R"(objects as "views", or as "cameras" with a "time" in "paths".)");
  command->add_option("--view", options->view, "Which view or path of that file, by its name, where it has several.")
      ->needs(camera);
  command->add_option("--time", options->time, "Seconds on the time of a path in that file: where it is then.")
      ->needs(camera);
  CLI::Option* eye = command->add_option("--eye", options->eye, "Place of the eye as x,y,z in world coordinates.");
  CLI::Option* target = command->add_option("--target", options->target, "Place the eye looks at, as x,y,z.");
  eye->needs(target)->excludes(camera);
  target->needs(eye)->excludes(camera);
  command->add_option("--up", options->up, "Direction that is up in the picture, as x,y,z.")
      ->needs(eye)
      ->capture_default_str();
  command->add_option("--fov", options->fov_deg, "Vertical field of view in degrees.")
      ->needs(eye)
      ->capture_default_str();
  add_color_flags(*command, options->color);
  add_stereo_flags(*command, options->stereo);
  add_eye_dome_flags(*command, options->eye_dome);
  command
      ->add_option("--until", options->until,
                   "When to stop: converged (nothing is left to draw), frame:N (after N frames) or ms:T (after T "
                   "milliseconds of drawing), whatever comes first.")
      ->capture_default_str();
  command->add_flag(
      "--while-loading", options->while_loading,
      "Draw from the first points on while the file is being read, as modes unstructured (as the papers do, --carry "
      "vertex or index) and hybrid (like unstructured, until its clusters are there) can. Times then count from the "
      "beginning of the reading. Colours of intensity, height and the like stretch over the first points read until "
      "all are; converged, the picture is that of all points, exactly. Not for octrees.");
  command->add_option("--stats", options->stats, "JSON file for what was drawn, how long it took, and all settings.");
  command->add_option("--position-out", options->position_out,
                      "NumPy file for the world coordinates of every pixel (height x width x 3 doubles, NaN where "
                      "no point is).");
  command->add_option("--depth-out", options->depth_out,
                      "NumPy file for the depth along the line of sight in world units (height x width floats, inf "
                      "where no point is).");
  add_json_flag(*command, options->json);
  command->footer(
      "Without --camera or --eye the cloud is seen obliquely and whole; with --while-loading, the box of which its "
      "header speaks.\n\n"
      "Example:\n  stipple render scan.las -o scan.png --mode hierarchical --size 1920x1080 --until ms:500");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
