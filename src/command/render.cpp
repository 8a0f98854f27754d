#include "src/command/render.h"

#include <memory>

#include "octree/core/error.h"
#include "octree/open/open.h"
#include "render/store/dataset.h"
#include "src/cli/cli.h"
#include "src/cli/stereo_flags.h"
#include "src/command/render_camera.h"
#include "src/command/render_options.h"
#include "src/command/render_picture.h"
#include "src/command/render_results.h"

namespace stipple {
namespace {

void run_while_loading(const RenderOptions& options, Mode mode, const glm::ivec2& size, const PointSize& point_size) {
  const auto source = open_source(options.inputs);
  const SourceInfo& info = source->info();
  for (const std::string& warning : info.warnings) warn(warning);
  check_memory(info, mode == Mode::hybrid, limits_of(options.draw));
  const auto asked = camera_asked_for(options);
  const Camera camera = asked ? *asked : proposed_camera(stated_corners(info), static_cast<double>(size.x) / size.y);
  const View view = view_asked_for(options, camera, size, info.grid);
  const LoadedPicture drawn = draw_loading_picture(options, mode, *source, view, point_size);
  write_results(options, drawn.picture, *drawn.dataset, view);
}

void run(const RenderOptions& options) {
  const std::optional<Mode> mode = mode_named(options.mode);
  const glm::ivec2 size = parse_size("--size", options.draw.size);
  const PointSize point_size = point_size_of(options.draw);
  parse_color("--background", options.draw.background);
  check(options.stereo, size);
  check_options(options, mode);
  if (options.while_loading) return run_while_loading(options, *mode, size, point_size);

  const Dataset dataset =
      open_dataset(options.inputs, color_choice_of(options.draw.color, options.color),
                   mode ? needs_of(*mode, skips_of(options.draw)) : DatasetNeeds{}, limits_of(options.draw));
  for (const std::string& warning : dataset.info.warnings) warn(warning);
  const auto asked = camera_asked_for(options);
  const Camera camera = asked ? *asked : proposed_camera(dataset.overview(), static_cast<double>(size.x) / size.y);
  const View view = view_asked_for(options, camera, size, dataset.points.grid);
  const Picture picture =
      mode ? draw_with_gl(options, *mode, dataset, view, point_size) : draw_reference(dataset, view, point_size);
  write_results(options, picture, dataset, view);
  if (picture.unread.parts > 0) throw Error(picture.unread.message());
}

}  // namespace

void add_render_command(CLI::App& app) {
  const auto options = std::make_shared<RenderOptions>();
  CLI::App* command = app.add_subcommand("render", "Draw one picture of a point cloud.");
  add_render_options(*command, *options);
  command->footer(
      "Without --camera or --eye the cloud is seen obliquely and whole; with --while-loading, the box of which its "
      "header speaks.\n\n"
      "Example:\n  stipple render scan.las -o scan.png --mode hierarchical --size 1920x1080 --until ms:500");
  command->callback([options] { run(*options); });
}

}  // namespace stipple
