#include "render/store/dataset.h"

#include <fmt/format.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>

#include "octree/build/builder.h"
#include "octree/cloud/cloud.h"
#include "octree/core/error.h"
#include "octree/core/stopwatch.h"
#include "octree/open/open.h"
#include "octree/store/open_tree.h"
#include "octree/store/tree_source.h"
#include "render/store/colorize.h"
#include "render/store/tree_ids.h"

namespace stipple {
namespace {

// Finaliser of splitmix64 (Steele, Lea, Flood 2014).
std::uint64_t mix(std::uint64_t x) {
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ull;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBull;
  return x ^ (x >> 31);
}

// Puts the points in the tree's order; ids become the order itself.
void to_store_order(PointSet& set, const Octree& octree) {
  Buffer<PackedPoint> ordered(set.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, set.size(), 16384), [&](const auto& range) {
    for (std::size_t i = range.begin(); i < range.end(); ++i) ordered[i] = set.points[octree.order[i]];
  });
  set.points = std::move(ordered);
  set.ids = octree.order;
}

std::vector<std::string> names_to_read(const ColorMap& colors, const Schema& schema, const DatasetNeeds& needs) {
  if (!needs.all_attributes) return attribute_names_of(colors, schema);
  std::vector<std::string> names;
  for (const auto& attribute : schema) names.push_back(attribute.name);
  return names;
}

// The points of the root, or of the nodes at which the tree begins, as a cloud of their own, with these attributes.
Cloud root_of(const TreeStore& tree, const std::vector<std::size_t>& attributes) {
  Cloud cloud;
  cloud.info = tree.info().source;
  for (const std::size_t index : attributes) cloud.columns.push_back({cloud.info.schema[index], {}});
  PointBatch batch;
  for (const StoredNode& node : uppermost_nodes(tree)) {
    tree.read_points(node, attributes, batch);
    cloud.positions.insert(cloud.positions.end(), batch.positions.begin(), batch.positions.end());
    for (std::size_t c = 0; c < attributes.size(); ++c)
      cloud.columns[c].bytes.insert(cloud.columns[c].bytes.end(), batch.columns[c].bytes.begin(),
                                    batch.columns[c].bytes.end());
  }
  for (const glm::ivec3& p : cloud.positions) cloud.bounds.extend(p);
  return cloud;
}

}  // namespace

void check_memory(const SourceInfo& info, bool with_octree, const MemoryLimits& limits) {
  const std::uint64_t bytes = info.point_count * (with_octree ? kBytesPerPointOfOctree : kBytesPerPoint);
  if (bytes <= limits.main) return;
  throw Error(
      fmt::format("{}: its {} points would take about {} bytes of memory, and {} are allowed. Allow more with "
                  "--memory, or build an octree (stipple build) and draw it in mode hierarchical.",
                  info.path, info.point_count, bytes, limits.main));
}

Dataset open_dataset(const std::string& path, const ColorChoice& color, const DatasetNeeds& needs,
                     const MemoryLimits& limits) {
  if (!is_tree(path)) {
    const auto source = open_source(path);
    check_memory(source->info(), needs.octree, limits);
    return load_dataset(*source, color, needs);
  }
  const Stopwatch watch;
  Dataset dataset;
  dataset.tree = open_tree(path);
  dataset.info = dataset.tree->info().source;
  if (needs.points) check_memory(dataset.info, false, limits);
  const std::string chosen = choose_color(dataset.info.schema, color.attribute);
  const ColorMap unstretched = color.complete({.attribute = chosen});
  const Cloud root = root_of(*dataset.tree, attributes_of(unstretched, dataset.info.schema));
  dataset.colors = color.complete(map_colors(*dataset.tree, root, chosen));
  dataset.root = make_point_set(root, dataset.colors);
  if (needs.points) {
    const TreeSource source(dataset.tree);
    dataset.info = source.info();
    dataset.points =
        make_point_set(load_cloud(source, names_to_read(dataset.colors, dataset.info.schema, needs)), dataset.colors);
    dataset.points.ids = ids_of(source.nodes());
    dataset.bytes_to_load = dataset.tree->bytes_read();
  } else {
    dataset.points.grid = dataset.info.grid;
  }
  dataset.load_seconds = watch.seconds();
  return dataset;
}

Dataset open_dataset(const std::vector<std::string>& paths, const ColorChoice& color, const DatasetNeeds& needs,
                     const MemoryLimits& limits) {
  if (paths.size() == 1) return open_dataset(paths.front(), color, needs, limits);
  const auto source = open_source(paths);
  check_memory(source->info(), needs.octree, limits);
  return load_dataset(*source, color, needs);
}

Dataset load_dataset(const PointSource& source, const ColorChoice& color, const DatasetNeeds& needs) {
  Dataset dataset;
  const Stopwatch watch;
  dataset.info = source.info();
  const std::string chosen = choose_color(dataset.info.schema, color.attribute);
  const ColorMap unstretched = color.complete({.attribute = chosen});
  const Cloud cloud = load_cloud(source, names_to_read(unstretched, dataset.info.schema, needs));
  dataset.colors = color.complete(map_colors(cloud, chosen));
  dataset.points = make_point_set(cloud, dataset.colors);
  dataset.load_seconds = watch.seconds();
  if (needs.octree) add_octree(dataset);
  return dataset;
}

void add_octree(Dataset& dataset) {
  const Stopwatch watch;
  PointSet& set = dataset.points;
  dataset.octree = std::make_shared<Octree>(build_octree(
      set.grid, set.bounds, PositionView(std::span<const PackedPoint>(set.points), &PackedPoint::position)));
  to_store_order(set, *dataset.octree);
  dataset.build_seconds = watch.seconds();
}

double near_plane(const Grid& grid) {
  return std::min({grid.scale.x, grid.scale.y, grid.scale.z});
}

std::uint64_t hash_points(const PointSet& set) {
  return tbb::parallel_reduce(
      tbb::blocked_range<std::size_t>(0, set.size(), 65536), std::uint64_t{0},
      [&](const auto& range, std::uint64_t sum) {
        for (std::size_t i = range.begin(); i < range.end(); ++i) {
          const PackedPoint& p = set.points[i];
          const auto x = static_cast<std::uint32_t>(p.position.x);
          const auto y = static_cast<std::uint32_t>(p.position.y);
          const auto z = static_cast<std::uint32_t>(p.position.z);
          // A sum does not depend on the order of its terms
          sum += mix(mix(mix(set.id(i)) ^ (std::uint64_t{x} << 32 | y)) ^ (std::uint64_t{z} << 32 | p.rgba));
        }
        return sum;
      },
      std::plus<>());
}

}  // namespace stipple
