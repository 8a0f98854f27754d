// What `stipple render` leaves: files, and what it prints.
#pragma once

#include "render/frame/camera.h"
#include "render/store/dataset.h"
#include "src/command/render_options.h"
#include "src/command/render_picture.h"

namespace stipple {

// Writes the picture, with settings and results in its text, and the other files that `options` name; prints results.
// Throws Error naming a file that cannot be written.
void write_results(const RenderOptions& options, const Picture& picture, const Dataset& dataset, const View& view);

}  // namespace stipple
