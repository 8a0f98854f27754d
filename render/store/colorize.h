// From a cloud's attributes to the packed colour that the GPU holds.
#pragma once

#include <glm/glm.hpp>
#include <span>
#include <string>
#include <vector>

#include "octree/cloud/cloud.h"
#include "octree/store/tree_store.h"
#include "render/frame/point_set.h"

namespace stipple {

// What to colour by: "rgb", "height", or the name of any attribute of the schema. An empty name picks the first there
// is of rgb, intensity, height. Throws UsageError listing what there is when the schema lacks the name.
std::string choose_color(const Schema& schema, const std::string& name);

// The attributes that load_cloud must read to colour by `color`.
std::vector<std::string> attributes_for_color(const std::string& color);

// How values of an attribute become colours.
struct ColorMap {
  enum class Kind {
    rgb8,     // the file keeps 8-bit values, in fields of whatever size
    rgb16,    // 16 bits, of which the upper byte counts
    classes,  // a fixed palette (LAS classes 0 to 18, repeating)
    grey,     // black at low to white at high
    ramp,     // a perceptual ramp from low to high
  };
  std::string attribute;  // "height": none, but the position
  Kind kind = Kind::ramp;
  double low = 0.0;
  double high = 1.0;

  bool operator==(const ColorMap&) const = default;
};

// The map for `color` (as choose_color gives it), stretched over these points: intensity becomes grey, other attributes
// and height a ramp from the 1st to the 99th percentile; of attributes with several components, the first. rgb of 16
// bits is taken as 8 bits when no channel of any point exceeds 255. Throws Error when the cloud lacks the column.
ColorMap map_colors(const Cloud& cloud, const std::string& color);

// The map for a tree on disk, stretched over its root, which is an even sample. Whether colours have 8 bits is what the
// tree says of their largest value.
ColorMap map_colors(const TreeStore& tree, const Cloud& root, const std::string& color);

// Colours points first, first + 1, ... of `positions` and `column` (the map's attribute; null for height), as many as
// `out` has room for.
void pack_points(const ColorMap& map, std::span<const glm::ivec3> positions, const Column* column, std::size_t first,
                 std::span<PackedPoint> out);

// Points with ids 0, 1, ... coloured by the map, on all cores.
PointSet make_point_set(const Cloud& cloud, const ColorMap& map);
// The same by the map stretched over the cloud itself.
PointSet make_point_set(const Cloud& cloud, const std::string& color);

}  // namespace stipple
