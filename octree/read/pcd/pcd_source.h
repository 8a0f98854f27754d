// Points from a PCD file.
#pragma once

#include <memory>
#include <string>

#include "octree/cloud/source.h"

namespace stipple {

// PCD of any version: ascii, with blanks or commas between numbers; binary; binary_compressed, which is unpacked when
// it is opened and stays in memory. Points of organised clouds come row by row. VIEWPOINT is not applied: positions are
// those of the file. Throws Error naming the byte or line when the header is wrong or the file ends before its last
// point.
std::unique_ptr<PointSource> open_pcd(const std::string& path);

}  // namespace stipple
