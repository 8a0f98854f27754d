// Points from a PLY file.
#pragma once

#include <memory>
#include <string>

#include "octree/cloud/source.h"

namespace stipple {

// The vertices of a PLY file, ascii or binary of either byte order: element "vertex", or, as displaz writes them, one
// element for each attribute: "vertex_position", "vertex_color" and so on. Other elements are skipped, and so are
// lists. In ascii, a row is a line. Throws Error naming the byte or line when the header is wrong, the file ends before
// its last vertex, or there are no vertices in it.
std::unique_ptr<PointSource> open_ply(const std::string& path);

}  // namespace stipple
