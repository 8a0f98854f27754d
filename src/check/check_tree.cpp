#include "src/check/check_tree.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <mutex>
#include <numeric>

#include "octree/core/error.h"
#include "src/check/check_node.h"
#include "src/check/closest_pair.h"

namespace stipple {
namespace {

using Histogram = std::array<std::uint64_t, 256>;

// What each thread gathers.
struct Tally {
  PointBatch batch;
  std::vector<double> closest_pairs;  // by level
  std::vector<Histogram> histograms;  // by attribute

  void add(const Tally& other) {
    for (std::size_t i = 0; i < closest_pairs.size(); ++i)
      closest_pairs[i] = std::min(closest_pairs[i], other.closest_pairs[i]);
    for (std::size_t a = 0; a < histograms.size(); ++a)
      for (std::size_t v = 0; v < 256; ++v) histograms[a][v] += other.histograms[a][v];
  }
};

// The first defect that any thread finds, by the node's place in the hierarchy.
class FirstDefect {
 public:
  void add(std::size_t node, Defect defect) {
    const std::scoped_lock lock(mutex_);
    if (node < node_) {
      node_ = node;
      defect_ = std::move(defect);
    }
  }
  const std::optional<Defect>& get() const { return defect_; }

 private:
  std::mutex mutex_;
  std::size_t node_ = std::numeric_limits<std::size_t>::max();
  std::optional<Defect> defect_;
};

std::vector<LevelReport> count_levels(const TreeStore& store, const std::vector<StoredNode>& nodes) {
  std::vector<LevelReport> levels;
  for (const StoredNode& node : nodes) {
    while (levels.size() <= static_cast<std::size_t>(node.level)) {
      levels.emplace_back();
      levels.back().spacing = std::ldexp(store.info().spacing, 1 - static_cast<int>(levels.size()));
    }
    LevelReport& level = levels[node.level];
    ++level.nodes;
    if (!node.is_leaf()) ++level.inner_nodes;
    level.points += node.points;
  }
  return levels;
}

std::optional<Defect> check_bytes(const TreeStore& store, const std::vector<StoredNode>& nodes) {
  if (store.info().node_files) return std::nullopt;  // locating the nodes held each file to what it should have
  const std::vector<StoredNode> ordered = in_store_order(store, nodes);
  if (!store.info().point_bytes) return std::nullopt;  // the file holds more than points
  std::uint64_t end = 0;
  for (const StoredNode& node : ordered) {
    if (node.byte_offset != end)
      return Defect{name_of(node),
                    fmt::format("bytes {} to {} of the points before it belong to no node", end, node.byte_offset)};
    end += node.byte_size;
  }
  if (end != *store.info().point_bytes)
    return Defect{
        "", fmt::format("the last node's points end at byte {}, and the file has {}", end, *store.info().point_bytes)};
  return std::nullopt;
}

std::optional<std::string> check_spacing(const TreeInfo& info, const StoredNode& node, double closest) {
  const double spacing = std::ldexp(info.spacing, -node.level);
  if (!info.minimal_distance || closest >= *info.minimal_distance * spacing * (1.0 - 1e-9)) return std::nullopt;
  return fmt::format("two of its points are {} apart, and at least {} of its spacing {} is promised", closest,
                     *info.minimal_distance, spacing);
}

void count_values(const PointBatch& batch, const std::vector<AttributeRange>& ranges, Tally& tally) {
  for (std::size_t a = 0; a < ranges.size(); ++a) {
    if (ranges[a].histogram.empty() || batch.columns[a].attribute.bytes() != 1) continue;
    for (const std::byte value : batch.columns[a].bytes) ++tally.histograms[a][std::to_integer<std::size_t>(value)];
  }
}

// All that one node has to hold. Errors of reading are defects like any other.
std::optional<std::string> check_node(const TreeStore& store, const StoredNode& node,
                                      std::span<const std::size_t> attributes, Tally& tally) {
  const TreeInfo& info = store.info();
  try {
    store.read_points(node, attributes, tally.batch);
    if (info.has_details && node.points > 0)
      if (auto defect = check_details(store.read_details(node), tally.batch)) return defect;
  } catch (const Error& error) {
    return error.what();
  }
  count_values(tally.batch, info.ranges, tally);
  if (auto defect = check_cell(info, node, tally.batch)) return defect;
  if (auto defect = check_ranges(info, tally.batch)) return defect;
  if (node.is_leaf()) return std::nullopt;
  const double closest = closest_pair(tally.batch.positions, info.source.grid.scale);
  tally.closest_pairs[node.level] = std::min(tally.closest_pairs[node.level], closest);
  return check_spacing(info, node, closest);
}

std::optional<Defect> check_histograms(const TreeInfo& info, const std::vector<Histogram>& counted) {
  for (std::size_t a = 0; a < info.ranges.size(); ++a) {
    if (info.ranges[a].histogram.empty() || info.source.schema[a].bytes() != 1) continue;
    for (std::size_t value = 0; value < 256; ++value)
      if (info.ranges[a].histogram[value] != counted[a][value])
        return Defect{
            "", fmt::format("{} is {} in {} points, and the metadata's histogram says {}", info.source.schema[a].name,
                            value, counted[a][value], info.ranges[a].histogram[value])};
  }
  return std::nullopt;
}

// Fills in the closest pairs. Returns the first defect.
std::optional<Defect> check_points(const TreeStore& store, const std::vector<StoredNode>& nodes, TreeReport& report) {
  const Tally empty{{},
                    std::vector(report.levels.size(), std::numeric_limits<double>::infinity()),
                    std::vector<Histogram>(store.info().ranges.size())};
  std::vector<std::size_t> attributes(store.info().source.schema.size());
  std::iota(attributes.begin(), attributes.end(), std::size_t{0});
  tbb::enumerable_thread_specific<Tally> tallies(empty);
  FirstDefect first;
  tbb::parallel_for(std::size_t{0}, nodes.size(), [&](std::size_t i) {
    if (auto what = check_node(store, nodes[i], attributes, tallies.local()))
      first.add(i, {name_of(nodes[i]), std::move(*what)});
  });
  Tally total = empty;
  for (const Tally& tally : tallies) total.add(tally);
  for (std::size_t i = 0; i < report.levels.size(); ++i) report.levels[i].closest_pair = total.closest_pairs[i];
  if (first.get()) return first.get();
  return check_histograms(store.info(), total.histograms);
}

}  // namespace

TreeReport check_tree(const TreeStore& store) {
  TreeReport report;
  std::vector<StoredNode> nodes;
  for (const StoredNode& node : read_whole_hierarchy(store)) {
    ++report.nodes;
    try {
      nodes.push_back(store.locate(node));
      report.point_bytes += nodes.back().byte_size;
    } catch (const Error& error) {
      if (!report.defect) report.defect = {name_of(node), error.what()};
    }
  }
  report.levels = count_levels(store, nodes);
  for (const LevelReport& level : report.levels) report.points += level.points;
  const SourceInfo& info = store.info().source;
  const std::uint64_t stated = info.point_count;
  if (!report.defect && !info.warnings.empty()) report.defect = {"", info.warnings.front()};
  if (!report.defect && stated != report.points)
    report.defect = {"", fmt::format("the metadata state {} points, and the nodes hold {}", stated, report.points)};
  if (!report.defect) report.defect = check_bytes(store, nodes);
  const std::optional<Defect> in_points = check_points(store, nodes, report);
  if (!report.defect) report.defect = in_points;
  return report;
}

}  // namespace stipple
