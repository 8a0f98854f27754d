#include "src/cli/draw_options.h"

#include <fmt/format.h>

#include <algorithm>

#include "octree/core/error.h"
#include "render/store/stream_buffer.h"
#include "src/cli/cli.h"

namespace stipple {

void add_draw_options(CLI::App& command, DrawOptions& options) {
  command.add_option("--size", options.size, "Width and height of the picture in pixels, as in 1920x1080.")
      ->capture_default_str();
  command
      .add_option("--raster", options.raster,
                  "Rasterizer: compute (shaders and atomics) or points (GL_POINTS, as the papers draw).")
      ->capture_default_str();
  CLI::Option* budget =
      command
          .add_option("--budget", options.budget,
                      "Points added a frame, at most 4194304, plain or with k or M for thousands or millions.")
          ->capture_default_str();
  command.add_option("--fps", options.fps, "Instead of a fixed budget: steer it to this many frames a second.")
      ->excludes(budget);
  command.add_option("--point-size", options.point_size, "Edge of a point's square in pixels.")->capture_default_str();
  command.add_option(
      "--splat-size", options.splat_size,
      fmt::format("Draw near points as round splats of this diameter, in the cloud's own units (metres, as a rule): "
                  "those whose splat is larger on the screen than --point-size, up to {} pixels. As in 0.05. Default: "
                  "no splats.",
                  PointSize::kLargestSplat));
  command.add_option("--color", options.color,
                     "Colour by rgb, height or any attribute (`stipple info` lists them). Default: the first there is "
                     "of rgb, intensity, height.");
  command.add_option("--background", options.background, "Colour of pixels without a point, as RRGGBB in hexadecimal.")
      ->capture_default_str();
  command.add_option("--seed", options.seed, "Seed of the shuffle of mode unstructured, a whole number from 0.")
      ->check(CLI::NonNegativeNumber)
      ->capture_default_str();
  command
      .add_option("--carry", options.carry,
                  "How mode unstructured carries what the last frame shows: vertex (Schuetz and others 2019) or index "
                  "(Schuetz and Wimmer 2018; not for octrees on disk).")
      ->capture_default_str();
  command
      .add_option(
          "--density", options.density,
          "How mode hierarchical estimates the pixels that a cluster's points can cover, by which it rations "
          "them: box-count (cells of a pixel's size that they occupy) or uniform (as if they were spread evenly "
          "over their box, as Tredinnick and others 2016 do).")
      ->capture_default_str();
  command.add_option("--memory", options.memory,
                     "Main memory that points may take, with k, M or G for powers of 1024 bytes; the program itself "
                     "comes on top. A cloud that needs more is refused, unless it is an octree on disk drawn in mode "
                     "hybrid, hierarchical or lod: then as much of it is held as fits. Default: no limit.");
  command.add_option(
      "--gpu-memory", options.gpu_memory,
      "The same for memory of the GPU. Default: no limit, but 1 GiB for what mode hybrid holds of an octree on "
      "disk.");
  command
      .add_option(
          "--no-skip", options.no_skip,
          "What mode hybrid is not to leave out, to see what that is worth: frustum (clusters outside of the view), "
          "occlusion (those wholly hidden), density (for now, points closer together than pixels), yield (for now, "
          "clusters whose points are not seen), rounds (frames that one round of all clusters would not fill), done "
          "(looking again at clusters with nothing left), still (drawing a still picture anew, as the published "
          "methods do), converged (frames after the last point, as far as --until goes), attributes (reading those "
          "that are not shown), nodes (reading those of an octree on disk that are not needed), or several, separated "
          "by commas.")
      ->delimiter(',');
}

void add_steer_option(CLI::App& command, DrawOptions& options) {
  command
      .add_option("--steer", options.steer,
                  "Who steers the budget to --fps: cpu (frames are timed from outside, in every mode) or gpu (mode "
                  "unstructured, as Schuetz and others 2019: the GPU takes the time and sets the next frame's points "
                  "itself, nothing is read back to draw; other modes are steered by the CPU still).")
      ->needs("--fps")
      ->capture_default_str();
}

RasterizerKind rasterizer_of(const DrawOptions& options) {
  const auto kind = rasterizer_named(options.raster);
  if (!kind) throw UsageError(fmt::format("--raster {}: expected points or compute", options.raster));
  return *kind;
}

BudgetPolicy budget_of(const DrawOptions& options) {
  BudgetPolicy policy;
  const std::uint64_t points = parse_count("--budget", options.budget);
  if (points > StreamBuffer::kLargestSection)
    throw UsageError(fmt::format("--budget {}: expected at most {} points a frame; mode brute-force draws all at once",
                                 options.budget, StreamBuffer::kLargestSection));
  policy.points = static_cast<std::uint32_t>(points);
  if (!options.fps.empty()) policy.frames_per_second = parse_positive("--fps", options.fps);
  return policy;
}

PointSize point_size_of(const DrawOptions& options) {
  const double pixels = parse_positive("--point-size", options.point_size);
  return {pixels, options.splat_size.empty() ? 0.0 : parse_positive("--splat-size", options.splat_size)};
}

MemoryLimits limits_of(const DrawOptions& options) {
  constexpr std::uint64_t kLeast = std::uint64_t{64} << 10;  // a thousand points a frame
  MemoryLimits limits;
  if (!options.memory.empty()) limits.main = parse_bytes("--memory", options.memory, kLeast);
  if (!options.gpu_memory.empty()) limits.gpu = parse_bytes("--gpu-memory", options.gpu_memory, kLeast);
  return limits;
}

Skips skips_of(const DrawOptions& options) {
  Skips skips;
  for (const std::string& name : options.no_skip) {
    const auto skip = std::ranges::find(all_skips(), name, &NamedSkip::name);
    if (skip == all_skips().end()) {
      std::string names;
      for (const NamedSkip& known : all_skips()) names += fmt::format("{}{}", names.empty() ? "" : ", ", known.name);
      throw UsageError(fmt::format("--no-skip {}: expected one of {}", name, names));
    }
    skips.*skip->member = false;
  }
  return skips;
}

MethodOptions method_options_of(const DrawOptions& options) {
  MethodOptions method{
      .seed = options.seed, .largest_budget = largest_budget(budget_of(options)), .limits = limits_of(options)};
  if (options.carry != "vertex" && options.carry != "index")
    throw UsageError(fmt::format("--carry {}: expected vertex or index", options.carry));
  method.carry_indices = options.carry == "index";
  if (options.density != "box-count" && options.density != "uniform")
    throw UsageError(fmt::format("--density {}: expected box-count or uniform", options.density));
  method.density = options.density == "uniform" ? DensityEstimate::uniform : DensityEstimate::box_count;
  if (options.steer != "cpu" && options.steer != "gpu")
    throw UsageError(fmt::format("--steer {}: expected cpu or gpu", options.steer));
  if (options.steer == "gpu")
    method.steering = GpuSteering{.target_ms = 1e3 / budget_of(options).frames_per_second.value()};
  method.skips = skips_of(options);
  return method;
}

Until parse_until(std::string_view text) {
  Until until;
  if (text == "converged") return until;
  if (text.starts_with("frame:")) {
    until.frames = parse_count("--until frame:", text.substr(6));
  } else if (text.starts_with("ms:")) {
    until.milliseconds = parse_positive("--until ms:", text.substr(3));
  } else {
    throw UsageError(fmt::format("--until {}: expected converged, frame:N or ms:T", text));
  }
  return until;
}

}  // namespace stipple
