#include "src/command/render_camera.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "octree/core/error.h"
#include "render/frame/propose_views.h"
#include "render/store/dataset.h"
#include "src/camera/camera_file.h"
#include "src/cli/cli.h"

namespace stipple {
namespace {

// The one called --view, or the only one there is.
template <class Named>
const Named& chosen(const std::vector<Named>& all, const RenderOptions& options, const char* kind) {
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

}  // namespace

std::optional<Camera> camera_asked_for(const RenderOptions& options) {
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

View view_asked_for(const RenderOptions& options, const Camera& camera, const glm::ivec2& size, const Grid& grid) {
  View view = make_view(camera, size, near_plane(grid));
  view.eyes_apart = eyes_apart_of(options.stereo, camera);
  return view;
}

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

}  // namespace stipple
