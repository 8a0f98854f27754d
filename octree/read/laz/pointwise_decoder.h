// Point formats 0 to 5: one stream of symbols, all items of a point after one another.
#pragma once

#include <memory>

#include "octree/read/laz/point_decoder.h"

namespace stipple::laz {

// `format.version` is 1 or 2.
std::unique_ptr<PointDecoder> make_pointwise_decoder(const InputFile& file, const Format& format);

}  // namespace stipple::laz
