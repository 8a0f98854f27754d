#include "src/command/render_results.h"

#include <fmt/format.h>

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "octree/core/output_file.h"
#include "render/measure/image.h"
#include "render/measure/npy.h"
#include "src/cli/cli.h"
#include "src/run/peak_memory.h"
#include "src/run/provenance.h"

namespace stipple {
namespace {

void write_arrays(const RenderOptions& options, const FrameData& frame, const Grid& grid) {
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
std::uint32_t budget_in_use(const RenderOptions& options, const Dataset& dataset) {
  const std::uint32_t budget = budget_of(options.draw).points;
  const bool streams = options.mode == name_of(Mode::hierarchical) && !dataset.in_memory();
  return streams ? budget_within(limits_of(options.draw), budget) : budget;
}

// Settings and results.
Json stats_of(const RenderOptions& options, const Picture& picture, const Dataset& dataset, const View& view) {
  const MethodOptions method = method_options_of(options.draw);
  const PointSize point_size = point_size_of(options.draw);
  const bool reference = options.mode == kReference;
  Json stats{{"mode", options.mode},
             {"raster", reference ? Json() : Json(options.draw.raster)},
             {"seed", options.draw.seed},
             {"carry", options.draw.carry},
             {"density", options.draw.density},
             {"budget", budget_in_use(options, dataset)},
             {"no_skip", no_skip_json(method.skips)},
             {"point_size", point_size.pixels},
             {"splat_size", point_size.world},
             {"background", options.draw.background},
             {"edl", json_of(shading_of(options))},
             {"load_ms", dataset.load_seconds * 1e3},
             {"build_ms", dataset.build_seconds * 1e3}};
  const auto fps = budget_of(options.draw).frames_per_second;
  stats["attributes_not_read"] =
      method.skips.attributes ? dataset.info.schema.size() - attributes_of(dataset.colors, dataset.info.schema).size()
                              : 0;
  stats["target_fps"] = fps ? Json(*fps) : Json();
  stats["steered_by"] = fps ? Json(options.draw.steer) : Json();
  stats.update(picture.stats);
  stats.update(dataset_provenance(dataset));
  stats.update(color_provenance(dataset.colors));
  stats["view"] = view_provenance(view);
  stats.update(program_provenance());
  stats["peak_memory_bytes"] = peak_memory();
  return stats;
}

void print_summary(const RenderOptions& options, const Json& stats) {
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

}  // namespace

void write_results(const RenderOptions& options, const Picture& picture, const Dataset& dataset, const View& view) {
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

}  // namespace stipple
