// Finds out what a file is by its content and opens it.
#pragma once

#include <memory>
#include <string>

#include "octree/cloud/source.h"

namespace stipple {

// Throws Error naming the file and what is read when the content is none of it.
std::unique_ptr<PointSource> open_file(const std::string& path);

}  // namespace stipple
