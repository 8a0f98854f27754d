// From a cloud's attributes to the packed colour that the GPU holds.
#pragma once

#include <string>
#include <vector>

#include "octree/cloud/cloud.h"
#include "render/frame/point_set.h"

namespace stipple {

// What to colour by: "rgb", "height", or the name of any attribute of the schema. An empty name picks the first there
// is of rgb, intensity, height. Throws UsageError listing what there is when the schema lacks the name.
std::string choose_color(const Schema& schema, const std::string& name);

// The attributes that load_cloud must read to colour by `color`.
std::vector<std::string> attributes_for_color(const std::string& color);

// Points with ids 0, 1, ... coloured by `color` (as choose_color gives it):
// - rgb of 16 bits becomes 8 bits by its upper byte, unless no channel of any point exceeds 255: then the file keeps
//   8-bit values in 16-bit fields, and they are taken as they are.
// - classification gets a fixed palette (LAS classes 0 to 18, repeating).
// - intensity becomes grey, every other attribute and height a perceptual ramp, both stretched from the 1st to the 99th
//   percentile; of attributes with several components, the first.
PointSet make_point_set(const Cloud& cloud, const std::string& color);

}  // namespace stipple
