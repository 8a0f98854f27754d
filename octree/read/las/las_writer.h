// Writes any source as a LAS file.
#pragma once

#include <string>

#include "octree/cloud/source.h"

namespace stipple {

// Writes LAS 1.4 in the point format that the source's attributes need: 2 (26 bytes a point) with "rgb", 3 with "rgb"
// and "gps-time", 1 with "gps-time", 0 with neither. Point i of the source is point i of the file, its integers and its
// grid untouched; bounds and counts by return are those of the points written.
//
// Also written where the source has them: "intensity" (u16), "classification" (u8, 0 to 31), "return number" and
// "number of returns" (u8, 0 to 7; 1 when the source does not say). All other attributes are left out.
//
// The file appears at `path` only when all of it is on the disk; until then what was there stays. Memory is bounded by
// the batches of the source, whatever its size. All cores write, each batch to its own place.
//
// Throws Error, and leaves nothing behind, when the source does, when it delivers other points than info() says, when
// an attribute has another type than the one given above (rgb: u16 x 3, gps-time: f64), when a value has more bits than
// its field, or when the system refuses to write; the message then holds `path` and the reason, a full disk say.
void write_las(const PointSource& source, const std::string& path);

}  // namespace stipple
