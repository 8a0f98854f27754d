// One cloud, ready for every method and the reference.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "octree/cloud/source.h"
#include "octree/tree/octree.h"
#include "render/frame/point_set.h"

namespace stipple {

// The points every renderer of a comparison shares. Where there is an octree they stand in its store order and keep the
// ids they have in the source, so that all methods, with a tree or without, break ties alike.
struct Dataset {
  SourceInfo info;
  std::string color;  // what the points are coloured by
  PointSet points;
  std::optional<Octree> octree;
  double load_seconds = 0.0;   // reading and colouring
  double build_seconds = 0.0;  // building the octree and putting the points in its order
};

// Reads and colours the source (see choose_color); builds the octree when asked to.
Dataset load_dataset(const PointSource& source, const std::string& color, bool with_octree);

// The near plane for a cloud: one cell of its grid along the finest axis. Points nearer than the grid can tell are
// clipped; reversed float depth loses nothing by it.
double near_plane(const Grid& grid);

// 64-bit hash of ids, positions and colours: equal for equal points, whatever order they stand in.
std::uint64_t hash_points(const PointSet& points);

}  // namespace stipple
