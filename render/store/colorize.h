// From a cloud's attributes to the packed colour that the GPU holds.
#pragma once

#include <bitset>
#include <glm/glm.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
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

// Colours from low to high. The first five are even steps to the eye; height_field is that of the height-field paper
// (GPGPU out-of-core ray tracing of airborne LiDAR, 2017).
enum class Ramp { viridis, magma, plasma, cividis, turbo, height_field };
std::span<const Ramp> all_ramps();
// "viridis", "magma", "plasma", "cividis", "turbo", "height-field".
std::string_view name_of(Ramp ramp);
std::optional<Ramp> ramp_named(std::string_view name);
// All of them, separated by commas.
std::string ramp_names();

// LAS classes.
using ClassSet = std::bitset<256>;
// The attribute that says of which class a point is.
inline constexpr const char* kClassAttribute = "classification";

// How values of an attribute become colours.
struct ColorMap {
  enum class Kind {
    rgb8,     // the file keeps 8-bit values, in fields of whatever size
    rgb16,    // 16 bits, of which the upper byte counts
    classes,  // a fixed palette (LAS classes 0 to 18, repeating)
    grey,     // black at low to white at high
    ramp,     // `ramp` from low to high
  };
  std::string attribute;  // "height": none, but the position
  Kind kind = Kind::ramp;
  double low = 0.0;
  double high = 1.0;
  Ramp ramp = Ramp::viridis;
  ClassSet hidden{};  // points of these classes are not drawn, where points have a class

  bool operator==(const ColorMap&) const = default;
};

// What is asked for: an attribute as choose_color() takes it, and the parts of a map that do not come from the points.
struct ColorChoice {
  ColorChoice() = default;
  ColorChoice(std::string name, Ramp its_ramp = Ramp::viridis, const ClassSet& not_drawn = {})
      : attribute(std::move(name)), ramp(its_ramp), hidden(not_drawn) {}
  ColorChoice(const char* name) : attribute(name) {}

  // The map with these parts of it.
  ColorMap complete(ColorMap map) const;

  std::string attribute;
  Ramp ramp = Ramp::viridis;
  ClassSet hidden;

  bool operator==(const ColorChoice&) const = default;
};

// The map for `color` (as choose_color gives it), stretched over these points: intensity becomes grey, other attributes
// and height a ramp from the 1st to the 99th percentile; of attributes with several components, the first. rgb of 16
// bits is taken as 8 bits when no channel of any point exceeds 255. Throws Error when the cloud lacks the column.
ColorMap map_colors(const Cloud& cloud, const std::string& color);

// The map for an attribute, or for heights in a column of that name, stretched over these values in the same way.
ColorMap map_colors(const Column& values);

// The map for a tree on disk, stretched over its root, which is an even sample. Whether colours have 8 bits is what the
// tree says of their largest value.
ColorMap map_colors(const TreeStore& tree, const Cloud& root, const std::string& color);

// The attributes of the schema that points coloured by the map need, by their numbers: its own, and the class where
// some are hidden.
std::vector<std::size_t> attributes_of(const ColorMap& map, const Schema& schema);
// Their names.
std::vector<std::string> attribute_names_of(const ColorMap& map, const Schema& schema);

// Colours points first, first + 1, ... of `positions` and `columns`, which hold those attributes, as many as `out` has
// room for.
void pack_points(const ColorMap& map, std::span<const glm::ivec3> positions, std::span<const Column> columns,
                 std::size_t first, std::span<PackedPoint> out);

// Those colours alone, of `count` points, on all cores. `columns` also hold heights (under that name) where the map is
// of them.
Buffer<std::uint32_t> pack_colors(const ColorMap& map, std::span<const Column> columns, std::size_t count);

// Takes points of these classes out of the picture and puts the others back; `classes` are those of the points whose
// colours these are. A colour that is not seen stays known.
void hide_classes(const ClassSet& hidden, const Column& classes, std::span<std::uint32_t> colors);

// Points with ids 0, 1, ... coloured by the map, on all cores.
PointSet make_point_set(const Cloud& cloud, const ColorMap& map);
// The same by the map stretched over the cloud itself.
PointSet make_point_set(const Cloud& cloud, const std::string& color);

}  // namespace stipple
