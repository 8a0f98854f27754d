// Which point of one cloud is which of another that was rounded to another grid.
#pragma once

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <utility>
#include <vector>

#include "render/frame/point_set.h"

namespace stipple::test {

// How far apart, along each axis, a point may be on two grids: half a step of each, as each rounded it once. Where one
// lattice holds the other there is nothing to round.
inline glm::dvec3 rounding_between(const Grid& a, const Grid& b) {
  glm::dvec3 most;
  for (int axis = 0; axis < 3; ++axis) {
    const double shift = (a.offset[axis] - b.offset[axis]) / b.scale[axis];
    const bool same_lattice =
        std::abs(a.scale[axis] / b.scale[axis] - 1.0) < 1e-9 && std::abs(shift - std::round(shift)) < 1e-3;
    most[axis] = same_lattice ? 2e-3 * a.scale[axis] : 0.5001 * (a.scale[axis] + b.scale[axis]);
  }
  return most;
}

// Finds for each point of `a` one of `b` of the same colour, no farther than `reach` along each axis, and never the
// same for two.
class PointPartners {
 public:
  static constexpr std::uint32_t kNone = kNoPoint;

  PointPartners(const PointSet& a, const PointSet& b, const glm::dvec3& reach)
      : a_(a), b_(b), reach_(reach), of_a_(a.size(), kNone), of_b_(b.size(), kNone), visited_(b.size(), 0) {
    for (std::uint32_t i = 0; i < b.size(); ++i) cells_.push_back({key(cell(relative(b, i))), i});
    std::ranges::sort(cells_);
    for (std::uint32_t i = 0; i < a.size(); ++i) find(i);
  }

  const std::vector<std::uint32_t>& of_a() const { return of_a_; }  // kNone: it has none
  const std::vector<std::uint32_t>& of_b() const { return of_b_; }
  std::size_t without() const { return static_cast<std::size_t>(std::ranges::count(of_a_, kNone)); }

 private:
  using Cell = glm::i64vec3;

  // From the first grid's origin, so that large coordinates lose nothing.
  glm::dvec3 relative(const PointSet& set, std::size_t i) const {
    return (set.grid.offset - a_.grid.offset) + set.grid.scale * glm::dvec3(set.points[i].position);
  }
  Cell cell(const glm::dvec3& place) const { return Cell(glm::floor(place / (2.0 * reach_))); }
  static std::uint64_t key(const Cell& cell) {
    return static_cast<std::uint64_t>(cell.x) * 0x9E3779B97F4A7C15u ^
           static_cast<std::uint64_t>(cell.y) * 0xC2B2AE3D27D4EB4Fu ^
           static_cast<std::uint64_t>(cell.z) * 0x165667B19E3779F9u;
  }

  // Nearest first.
  std::vector<std::uint32_t> candidates(std::uint32_t i) const {
    const glm::dvec3 place = relative(a_, i);
    const Cell low = cell(place - reach_), high = cell(place + reach_);
    std::vector<std::pair<double, std::uint32_t>> found;
    for (auto x = low.x; x <= high.x; ++x)
      for (auto y = low.y; y <= high.y; ++y)
        for (auto z = low.z; z <= high.z; ++z)
          for (auto at = std::ranges::lower_bound(cells_, std::pair(key({x, y, z}), 0u));
               at != cells_.end() && at->first == key({x, y, z}); ++at) {
            const glm::dvec3 away = glm::abs(relative(b_, at->second) - place);
            if (glm::all(glm::lessThanEqual(away, reach_)) && b_.points[at->second].rgba == a_.points[i].rgba)
              found.push_back({glm::dot(away, away), at->second});
          }
    std::ranges::sort(found);
    std::vector<std::uint32_t> nearest;
    for (const auto& [distance, b] : found) nearest.push_back(b);
    return nearest;
  }

  void find(std::uint32_t i) {
    ++round_;
    augment(i, 0);
  }

  // Bipartite matching after Kuhn: a partner that is taken is freed when its owner finds another. How deep it may look
  // is bounded; what stays alone then makes the test fail, not pass.
  bool augment(std::uint32_t i, int depth) {
    const std::vector<std::uint32_t> all = candidates(i);
    for (const std::uint32_t b : all)
      if (of_b_[b] == kNone) return pair(i, b);
    if (depth == 200) return false;
    for (const std::uint32_t b : all) {
      if (std::exchange(visited_[b], round_) == round_) continue;
      if (augment(of_b_[b], depth + 1)) return pair(i, b);
    }
    return false;
  }
  bool pair(std::uint32_t a, std::uint32_t b) {
    of_a_[a] = b;
    of_b_[b] = a;
    return true;
  }

  const PointSet& a_;
  const PointSet& b_;
  const glm::dvec3 reach_;
  std::vector<std::uint32_t> of_a_;
  std::vector<std::uint32_t> of_b_;
  std::vector<std::uint32_t> visited_;  // in which round, of `b`
  std::uint32_t round_ = 0;
  std::vector<std::pair<std::uint64_t, std::uint32_t>> cells_;
};

}  // namespace stipple::test
