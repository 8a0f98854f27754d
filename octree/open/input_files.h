// Which files a path given by the user means.
#pragma once

#include <string>
#include <vector>

namespace stipple {

// A file or an octree is itself; any other folder is the point cloud files in it, in the order of their names, without
// those of folders below. Which they are is told by their names: .las, .laz, .ply, .pcd, .obj, .xyz, .pts, .asc and
// .e57, whether they can be read or not, so that none is left out in silence. Throws Error when a folder cannot be
// listed or holds none.
std::vector<std::string> input_files(const std::string& path);

}  // namespace stipple
