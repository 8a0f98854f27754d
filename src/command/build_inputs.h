// The files that a command line means.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "octree/cloud/source.h"

namespace stipple {

// Opens every file and octree that the paths mean (see open_each()) and prints their warnings.
std::vector<std::unique_ptr<PointSource>> open_inputs(const std::vector<std::string>& paths);

}  // namespace stipple
