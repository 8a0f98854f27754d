// Opens whatever holds points: files and octrees.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "octree/cloud/source.h"

namespace stipple {

// What `path` is, is found out by its content: a file (see open_file()), an octree, which then is read whole (see
// TreeSource), or a folder of files (see input_files()), which are one cloud (see JoinedSource). Throws Error naming
// the file and what is read when the content is none of it.
std::unique_ptr<PointSource> open_source(const std::string& path);

// All of them as one cloud; at least one.
std::unique_ptr<PointSource> open_source(const std::vector<std::string>& paths);

// Every file and octree that the paths mean, one by one.
std::vector<std::unique_ptr<PointSource>> open_each(const std::vector<std::string>& paths);

}  // namespace stipple
