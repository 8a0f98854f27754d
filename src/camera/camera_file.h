// Cameras as JSON, the same for every command:
//
// {"views": [{"name": "oblique", "eye": [x, y, z], "target": [x, y, z], "up": [0, 0, 1], "fov_deg": 60}, ...],
//  "paths": [{"name": "walk", "cameras": [{"time": 0, "eye": ..., "target": ..., "up": ..., "fov_deg": ...}, ...]}]}
//
// or one view alone. World coordinates in the cloud's own units, time in seconds; up and fov_deg may be left out, names
// too.
#pragma once

#include <string>
#include <vector>

#include "render/frame/propose_views.h"
#include "src/camera/camera_path.h"
#include "src/json/json.h"

namespace stipple {

struct CameraFile {
  std::vector<NamedCamera> views;
  std::vector<CameraPath> paths;
};

// At least one view or path; those without a name are called "view-1", "view-2", ..., "path-1", ... Throws Error naming
// the file, the view or camera of a path, and what is expected there.
CameraFile read_camera_file(const std::string& path);
// Its views; Error when it has none.
std::vector<NamedCamera> read_cameras(const std::string& path);
// Its paths; Error when it has none.
std::vector<CameraPath> read_paths(const std::string& path);

// The object that stands for a view in such a file.
Json json_of(const NamedCamera& camera);
// The object that stands for a path.
Json json_of(const CameraPath& path);

}  // namespace stipple
