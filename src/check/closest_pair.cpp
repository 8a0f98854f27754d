#include "src/check/closest_pair.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include "octree/build/hash.h"

namespace stipple {
namespace {

// Points hashed by the cell of edge `edge` that they are in. As long as no two are closer than the edge, a cell holds a
// handful. Cells that share a slot of the table are not told apart: their points are compared for nothing.
class CellTable {
 public:
  explicit CellTable(const std::vector<glm::dvec3>& points)
      : points_(points), heads_(std::bit_ceil(2 * points.size())), next_(points.size()) {}

  // Empties the table and puts the first `count` points into it.
  void rebuild(double edge, std::uint32_t count) {
    edge_ = edge;
    std::ranges::fill(heads_, kNone);
    for (std::uint32_t i = 0; i < count; ++i) insert(i);
  }

  void insert(std::uint32_t i) {
    std::uint32_t& head = heads_[slot(cell(i))];
    next_[i] = head;
    head = i;
  }

  // The distance to the nearest point in the table, if it is below the edge; else the edge.
  double nearest(std::uint32_t i) const {
    const glm::dvec3 centre = cell(i);
    double nearest = edge_;
    for (int neighbour = 0; neighbour < 27; ++neighbour) {
      const glm::dvec3 step(neighbour / 9 - 1, neighbour / 3 % 3 - 1, neighbour % 3 - 1);
      for (std::uint32_t other = heads_[slot(centre + step)]; other != kNone; other = next_[other])
        nearest = std::min(nearest, glm::distance(points_[i], points_[other]));
    }
    return nearest;
  }

 private:
  static constexpr std::uint32_t kNone = std::numeric_limits<std::uint32_t>::max();

  glm::dvec3 cell(std::uint32_t i) const { return glm::floor(points_[i] / edge_); }
  std::size_t slot(const glm::dvec3& cell) const {
    std::uint64_t hash = 0;
    // Adding zero makes one of the two zeros that a double has
    for (int axis = 0; axis < 3; ++axis) hash = mix64(hash + std::bit_cast<std::uint64_t>(cell[axis] + 0.0));
    return hash & (heads_.size() - 1);
  }

  const std::vector<glm::dvec3>& points_;
  double edge_ = 0.0;
  std::vector<std::uint32_t> heads_;
  std::vector<std::uint32_t> next_;
};

// World units, measured from the first point, in random order: then the edge shrinks a logarithmic number of times.
std::vector<glm::dvec3> shuffled(std::span<const glm::ivec3> positions, const glm::dvec3& scale) {
  std::vector<glm::dvec3> points;
  points.reserve(positions.size());
  for (const glm::ivec3& p : positions) points.push_back((glm::dvec3(p) - glm::dvec3(positions[0])) * scale);
  Random random(0, positions.size());
  for (std::size_t i = points.size(); i > 1; --i)
    std::swap(points[i - 1], points[random.below(static_cast<std::uint32_t>(i))]);
  return points;
}

}  // namespace

double closest_pair(std::span<const glm::ivec3> positions, const glm::dvec3& scale) {
  if (positions.size() < 2) return std::numeric_limits<double>::infinity();
  const std::vector<glm::dvec3> points = shuffled(positions, scale);
  double closest = glm::distance(points[0], points[1]);
  CellTable table(points);
  table.rebuild(closest, 2);
  for (std::uint32_t i = 2; i < points.size() && closest > 0.0; ++i) {
    const double distance = table.nearest(i);
    if (distance < closest) {
      closest = distance;
      if (closest > 0.0) table.rebuild(closest, i + 1);
    } else {
      table.insert(i);
    }
  }
  return closest;
}

}  // namespace stipple
