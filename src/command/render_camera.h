// From where `stipple render` looks.
#pragma once

#include <optional>

#include "octree/cloud/source.h"
#include "render/frame/camera.h"
#include "render/frame/point_set.h"
#include "src/command/render_options.h"

namespace stipple {

// By --camera or --eye; nothing where neither is given. Throws UsageError naming the option, or Error of the file.
std::optional<Camera> camera_asked_for(const RenderOptions& options);

// Sees all of `points` obliquely. `aspect`: width over height of the picture.
Camera proposed_camera(const PointSet& points, double aspect);

// What `camera` sees in a picture of `size` pixels, for the eyes that --stereo asks for. `grid`: of the cloud.
View view_asked_for(const RenderOptions& options, const Camera& camera, const glm::ivec2& size, const Grid& grid);

// The points of a picture that is drawn while they are read are not known when the camera is: what the header says of
// them is. Throws UsageError when it says nothing.
PointSet stated_corners(const SourceInfo& info);

}  // namespace stipple
