// One cloud, ready for every method and the reference.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/store/tree_store.h"
#include "octree/tree/octree.h"
#include "render/frame/point_set.h"
#include "render/store/colorize.h"
#include "render/store/memory_limits.h"

namespace stipple {

// The points every renderer of a comparison shares. Where an octree was built they stand in its store order and keep
// the ids they have in the source, so that all methods, with a tree or without, break ties alike. Of an octree on disk
// the ids are those of first_id_of(), in memory and on disk.
struct Dataset {
  SourceInfo info;
  ColorMap colors;                        // what the points are coloured by
  PointSet points;                        // grid and bounds alone, where a tree on disk was not to be loaded
  std::shared_ptr<const Octree> octree;   // null: none was built
  std::shared_ptr<const TreeStore> tree;  // the input itself, if it is an octree on disk
  PointSet root;                          // the points of its root, or of where it begins
  std::uint64_t bytes_to_load = 0;        // read from it to have all points in memory; 0 where they are not
  double load_seconds = 0.0;              // reading and colouring
  double build_seconds = 0.0;             // building the octree and putting the points in its order

  // Whether `points` holds all points.
  bool in_memory() const { return points.size() == info.point_count; }
  // Points by which to propose cameras: the same, whatever was loaded.
  const PointSet& overview() const { return tree ? root : points; }
};

// What is wanted of an input.
struct DatasetNeeds {
  bool points = true;   // all points in memory; of a file they always are
  bool octree = false;  // an octree, in memory where the input is none itself
  // Read those that are not shown as well, and leave them aside: to see what that takes.
  bool all_attributes = false;
};

// What serves both.
inline DatasetNeeds operator|(const DatasetNeeds& a, const DatasetNeeds& b) {
  return {a.points || b.points, a.octree || b.octree, a.all_attributes || b.all_attributes};
}

// Throws Error when loading so many points, and building the octree, takes more than limits.main.
void check_memory(const SourceInfo& info, bool with_octree, const MemoryLimits& limits);

// Opens, reads and colours `path` (see open_source() and choose_color()). Throws Error before it reads points that
// limits.main has no room for.
Dataset open_dataset(const std::string& path, const ColorChoice& color, const DatasetNeeds& needs,
                     const MemoryLimits& limits = {});
// All of them as one cloud; an octree among several is read like a file.
Dataset open_dataset(const std::vector<std::string>& paths, const ColorChoice& color, const DatasetNeeds& needs,
                     const MemoryLimits& limits = {});

// Reads and colours a source that is no tree; its points are needed, whatever `needs` says.
Dataset load_dataset(const PointSource& source, const ColorChoice& color, const DatasetNeeds& needs);

// Builds the octree of all points, which are in memory, and puts them in its order.
void add_octree(Dataset& dataset);

// The near plane for a cloud: one cell of its grid along the finest axis. Points nearer than the grid can tell are
// clipped; reversed float depth loses nothing by it.
double near_plane(const Grid& grid);

// 64-bit hash of ids, positions and colours: equal for equal points, whatever order they stand in.
std::uint64_t hash_points(const PointSet& points);

}  // namespace stipple
