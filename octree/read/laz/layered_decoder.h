// Point formats 6 to 10: a stream for each value of a point.
#pragma once

#include <memory>
#include <span>

#include "octree/read/laz/point_decoder.h"

namespace stipple::laz {

// Layers that none of `fields` needs are neither read nor decoded. `format.version` is 3 or 4.
std::unique_ptr<PointDecoder> make_layered_decoder(const InputFile& file, const Format& format,
                                                   std::span<const las::Field> fields);

}  // namespace stipple::laz
