// What it takes to repeat a result.
#pragma once

#include <string>

#include "render/frame/camera.h"
#include "render/gpu/context.h"
#include "render/method/skips.h"
#include "render/store/dataset.h"
#include "src/json/json.h"

namespace stipple {

// The document as text, on one line when `indent` is negative. Bytes that are not UTF-8 (in paths) become U+FFFD.
std::string text_of(const Json& document, int indent = -1);

// {"version", "machine": {"cpu", "cores", "system"}}
Json program_provenance();
// {"gl_platform", "gl_renderer", "gl_version", "gl_atomic_bits"}; the context is current.
Json context_provenance(const HeadlessContext& context);
// {"path", "format", "points_total", "points_hash", "color", "bounds", "grid"}
Json dataset_provenance(const Dataset& dataset);
// The names of those that are turned off.
Json no_skip_json(const Skips& skips);
// {"eye", "right", "up", "forward", "fov_deg", "near", "width", "height"}
Json view_provenance(const View& view);

}  // namespace stipple
