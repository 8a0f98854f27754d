// Opens whatever holds points: files and octrees.
#pragma once

#include <memory>
#include <string>

#include "octree/cloud/source.h"

namespace stipple {

// What `path` is, is found out by its content: a file (see open_file()) or an octree, which then is read whole (see
// TreeSource). Throws Error naming the file and what is read when the content is none of it.
std::unique_ptr<PointSource> open_source(const std::string& path);

}  // namespace stipple
