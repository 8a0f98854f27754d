#include "src/command/render_picture.h"

#include <utility>
#include <vector>

#include "octree/core/stopwatch.h"
#include "render/gpu/context.h"
#include "render/reference/reference.h"
#include "src/cli/cli.h"
#include "src/run/loading_run.h"
#include "src/run/provenance.h"
#include "src/run/view_run.h"

namespace stipple {
namespace {

FrameData read_picture(ProgressiveRenderer& renderer, const View& view, const std::optional<EyeDomeOptions>& shading) {
  EyeDome eye_dome;
  std::vector<FrameData> frames;
  for (std::size_t eye = 0; eye < view.eyes(); ++eye) {
    frames.push_back(renderer.read(eye));
    if (shading) frames.back().rgba = read_colors(eye_dome.shade(*renderer.frame(eye), *shading));
  }
  return side_by_side(std::move(frames));
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

Json skipped_json(const std::optional<SkipCounts>& skipped) {
  if (!skipped) return nullptr;
  return {{"clusters_outside", skipped->clusters_outside}, {"points_outside", skipped->points_outside},
          {"clusters_hidden", skipped->clusters_hidden},   {"points_hidden", skipped->points_hidden},
          {"points_put_off", skipped->points_put_off},     {"clusters_done", skipped->clusters_done},
          {"rounds_joined", skipped->rounds_joined}};
}

Json stats_of(const View& view, const FrameState& state, const SelectionCounts& counts, const Unread& unread = {}) {
  return {{"views", view.eyes()},
          {"points_drawn", state.points_drawn},
          {"points_reprojected", state.points_reprojected},
          {"points_in_views", state.points_in_views()},
          {"frames", state.frame},
          {"converged", state.converged && unread.parts == 0},
          {"parts_unread", unread.parts},
          {"ms", state.milliseconds},
          {"covered_pixels", state.covered_pixels},
          {"stereo", stereo_json(view, state.eyes)},
          {"nodes_visible", counts.nodes_visible},
          {"nodes_occluded", counts.nodes_occluded},
          {"pixels_estimated", counts.pixels_estimated},
          {"clusters_far", counts.clusters_far},
          {"clusters_near", counts.clusters_near},
          {"clusters_across", counts.clusters_across},
          {"bytes_read", counts.bytes_read},
          {"points_read", counts.points_read}};
}

Json loading_json(LoadingDrawing& drawing, const FrameState& last, Json frames) {
  const LoadingDrawing::Times& times = drawing.times();
  return {{"first_points_ms", json_of(times.first_points_ms)},
          {"loaded_ms", json_of(times.loaded_ms)},
          {"clusters_ms", json_of(times.clusters_ms)},
          {"converged_ms", last.converged ? Json(last.milliseconds) : Json()},
          {"points_loaded", drawing.loading().points_loaded()},
          {"bytes_uploaded", drawing.loading().bytes_uploaded()},
          {"color_bytes_uploaded", drawing.loading().color_bytes_uploaded()},
          {"frames", std::move(frames)}};
}

}  // namespace

Picture draw_reference(const Dataset& dataset, const View& view, const PointSize& point_size) {
  FrameState state{.frame = 1, .points_drawn = dataset.points.size(), .converged = true};
  std::vector<FrameData> frames;
  Stopwatch watch;
  for (std::size_t eye = 0; eye < view.eyes(); ++eye) {
    frames.push_back(render_reference(dataset.points, view.of_eye(eye), point_size));
    state.eyes.push_back({.covered_pixels = frames.back().covered_pixels()});
    state.covered_pixels += state.eyes.back().covered_pixels;
  }
  state.milliseconds = watch.lap() * 1e3;
  Picture picture{side_by_side(std::move(frames)), stats_of(view, state, {})};
  picture.stats["gl_renderer"] = nullptr;
  return picture;
}

Picture draw_with_gl(const RenderOptions& options, Mode mode, const Dataset& dataset, const View& view,
                     const PointSize& point_size) {
  const BudgetPolicy policy = budget_of(options.draw);
  const HeadlessContext context;
  const auto method = make_method(mode, dataset, method_options_of(options.draw));
  ProgressiveRenderer renderer(*method, rasterizer_of(options.draw), dataset.points.grid, point_size);
  Until until = parse_until(options.until);
  until.converged = !method->draws_on() || !(until.frames || until.milliseconds);
  const FrameState state = run_view(renderer, view, policy, until);
  const Unread unread = method->unread();
  Picture picture{read_picture(renderer, view, shading_of(options)), stats_of(view, state, method->counts(), unread),
                  unread};
  picture.stats["skipped"] = skipped_json(method->skipped());
  picture.stats.update(context_provenance(context));
  return picture;
}

LoadedPicture draw_loading_picture(const RenderOptions& options, Mode mode, const PointSource& source, const View& view,
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

}  // namespace stipple
