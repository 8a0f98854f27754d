#include "src/check/check_node.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>

namespace stipple {
namespace {

std::string corner_text(const glm::dvec3& v) {
  return fmt::format("({}, {}, {})", v.x, v.y, v.z);
}

// Limits are printed and read back as decimals.
constexpr double kDecimalRounding = 1e-9;

// In grid steps. PotreeConverter states the bounds of its input, rounded; then it rounds the points. The same lion: 1.
constexpr double kPositionTolerance = 1.5;

// Limits of one component. NaN holds everything.
struct Limits {
  double min = std::nan("");
  double max = std::nan("");

  bool hold(double value) const {
    return !(value < min - kDecimalRounding * std::abs(min)) && !(value > max + kDecimalRounding * std::abs(max));
  }
};

Limits limits_of(const AttributeRange& range, int component) {
  const auto c = static_cast<std::size_t>(component);
  if (c >= range.min.size() || c >= range.max.size()) return {};
  return {range.min[c], range.max[c]};
}

std::optional<std::string> check_column(const Column& column, const AttributeRange& range) {
  const Attribute& attribute = column.attribute;
  for (int c = 0; c < attribute.components; ++c) {
    const Limits limits = limits_of(range, c);
    for (std::size_t i = 0; i < column.points(); ++i) {
      const double value = value_at(column, i, c);
      // PotreeConverter states the ranges of scaled attributes as they are stored
      if (limits.hold(value) || limits.hold((value - attribute.offset) / attribute.scale)) continue;
      return fmt::format("{} of its point {} is {}, and {} to {} is the range that the metadata state", attribute.name,
                         i, value, limits.min, limits.max);
    }
  }
  return std::nullopt;
}

GridBox box_of(std::span<const glm::ivec3> positions) {
  GridBox box;
  for (const glm::ivec3& p : positions) box.extend(p);
  return box;
}

// One to as many cells as points on each level, and never fewer than on the level above.
bool can_be_profile(const BoxCounts& profile, std::uint64_t points) {
  return profile.occupied.front() >= 1 && std::ranges::is_sorted(profile.occupied) && profile.occupied.back() <= points;
}

}  // namespace

std::optional<std::string> check_cell(const TreeInfo& info, const StoredNode& node, const PointBatch& points) {
  const Grid& grid = info.source.grid;
  const WorldBox cell = node.box ? world_box(grid, *node.box) : cell_of(info.cube, node);
  const glm::dvec3 min = node.box ? glm::dvec3(node.box->min) : grid.grid_from_world(cell.min - info.cell_margin);
  const glm::dvec3 max = node.box ? glm::dvec3(node.box->max) : grid.grid_from_world(cell.max + info.cell_margin);
  for (std::size_t i = 0; i < points.positions.size(); ++i) {
    const glm::dvec3 p(points.positions[i]);
    if (glm::all(glm::lessThanEqual(min, p)) && glm::all(glm::lessThanEqual(p, max))) continue;
    return fmt::format("its point {} at {} is outside its cell, {} to {}", i, corner_text(grid.world_from_grid(p)),
                       corner_text(cell.min), corner_text(cell.max));
  }
  return std::nullopt;
}

std::optional<std::string> check_ranges(const TreeInfo& info, const PointBatch& points) {
  const Grid& grid = info.source.grid;
  for (int axis = 0; axis < 3; ++axis) {
    const Limits limits = limits_of(info.position_range, axis);
    const double tolerance = kPositionTolerance * grid.scale[axis];
    for (std::size_t i = 0; i < points.positions.size(); ++i) {
      const double value = grid.offset[axis] + grid.scale[axis] * points.positions[i][axis];
      if (!(value < limits.min - tolerance) && !(value > limits.max + tolerance)) continue;
      return fmt::format("{} of its point {} is {}, and {} to {} is the range that the metadata state", "xyz"[axis], i,
                         value, limits.min, limits.max);
    }
  }
  for (std::size_t c = 0; c < points.columns.size(); ++c)
    if (auto defect = check_column(points.columns[c], info.ranges[c])) return defect;
  return std::nullopt;
}

std::optional<std::string> check_details(const NodeDetails& details, const PointBatch& points) {
  const std::span<const glm::ivec3> positions(points.positions);
  if (details.box != box_of(positions)) return "its box is not tight around its points";
  if (!can_be_profile(details.profile, positions.size())) return "its box-count profile is none of so many points";
  std::size_t end = 0;
  for (std::size_t c = 0; c < details.clusters.size(); ++c) {
    const Cluster& cluster = details.clusters[c];
    if (cluster.first != end || cluster.count == 0 || cluster.count > positions.size() - end)
      return fmt::format("its cluster {} holds {} points from {} on; it was expected to begin at {} of {}", c,
                         cluster.count, cluster.first, end, positions.size());
    end += cluster.count;
    if (cluster.box != box_of(positions.subspan(cluster.first, cluster.count)))
      return fmt::format("the box of its cluster {} is not tight around its points", c);
    if (!can_be_profile(cluster.profile, cluster.count))
      return fmt::format("the box-count profile of its cluster {} is none of so many points", c);
  }
  if (end != positions.size()) return fmt::format("its clusters hold {} of its {} points", end, positions.size());
  return std::nullopt;
}

}  // namespace stipple
