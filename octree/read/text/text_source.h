// Points from plain text.
#pragma once

#include <memory>
#include <string>

#include "octree/cloud/source.h"
#include "octree/read/text/text_start.h"

namespace stipple {

// Lines of numbers, a point each: x, y, z, and what columns_of() makes of the rest. `start` is what read_start() found.
// SourceInfo::encoding says what the columns are and how that was found out. Throws Error naming the line that has
// other things than numbers, or more or fewer of them than the first.
std::unique_ptr<PointSource> open_text(const std::string& path, const TextStart& start);

}  // namespace stipple
