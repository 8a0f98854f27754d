// Cameras as JSON: {"views": [{"name": "oblique", "eye": [x, y, z], "target": [x, y, z], "up": [0, 0, 1],
// "fov_deg": 60}, ...]} or one such object alone. World coordinates in the cloud's own units; up and fov_deg may be
// left out, names too.
#pragma once

#include <string>
#include <vector>

#include "render/frame/propose_views.h"
#include "src/json/json.h"

namespace stipple {

// At least one camera; views without a name are called "view-1", "view-2", ... Throws Error naming the file, the view
// and what is expected there.
std::vector<NamedCamera> read_cameras(const std::string& path);

// The object that read_cameras takes.
Json json_of(const NamedCamera& camera);

}  // namespace stipple
