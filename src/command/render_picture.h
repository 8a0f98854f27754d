// The picture of `stipple render`, by whatever draws it.
#pragma once

#include <memory>

#include "octree/cloud/source.h"
#include "render/frame/camera.h"
#include "render/frame/frame_data.h"
#include "render/store/dataset.h"
#include "src/command/render_options.h"
#include "src/json/json.h"

namespace stipple {

// What was drawn, and in how many frames, of how many points, in what time.
struct Picture {
  FrameData frame;
  Json stats;
  Unread unread{};  // what it lacks
};

Picture draw_reference(const Dataset& dataset, const View& view, const PointSize& point_size);

// Until --until says so. Throws UsageError naming an option.
Picture draw_with_gl(const RenderOptions& options, Mode mode, const Dataset& dataset, const View& view,
                     const PointSize& point_size);

// What there is of the cloud when drawing ends: all of it, or what could be read.
struct LoadedPicture {
  Picture picture;
  std::shared_ptr<const Dataset> dataset;
};

// The same from the first points of `source` on, while they are read.
LoadedPicture draw_loading_picture(const RenderOptions& options, Mode mode, const PointSource& source, const View& view,
                                   const PointSize& point_size);

}  // namespace stipple
