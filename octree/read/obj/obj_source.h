// Points from a Wavefront OBJ file.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include "octree/cloud/source.h"

namespace stipple {

// Whether the first line that is no comment begins as lines of OBJ files do. `start`: the first bytes of a file.
bool begins_obj(std::string_view start);

// The vertices, "v x y z [w] [red green blue]", in the order of the file; everything else is skipped, and so is w.
// Where some vertices have a colour, the others are white. Throws Error naming the line of a vertex that is none.
std::unique_ptr<PointSource> open_obj(const std::string& path);

}  // namespace stipple
