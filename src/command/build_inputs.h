// The files that a command line means.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "octree/cloud/source.h"

namespace stipple {

// Opens all files and octrees, and of other folders all files in them whose extension is one of a point cloud format,
// by name. Throws Error when one cannot be opened, or a folder holds none.
std::vector<std::unique_ptr<PointSource>> open_inputs(const std::vector<std::string>& paths);

}  // namespace stipple
