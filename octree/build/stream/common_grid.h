// One grid for the points of several sources.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "octree/cloud/grid.h"

namespace stipple {

// A source's grid and the box that its points take there; empty when it has none.
struct GriddedBox {
  Grid grid;
  GridBox box;
};

// A grid that holds all boxes in int32. Lossless where one exists: the sources' own when they agree, else the coarsest
// of which all scales are whole multiples and on which all offsets lie (up to the rounding of the doubles that state
// them). Where none does, or where it would need more than 32 bits, the finest scale that fits; positions are rounded.
Grid common_grid(std::span<const GriddedBox> sources);

// From one grid to another.
class GridTransform {
 public:
  GridTransform(const Grid& from, const Grid& to);

  bool identity() const { return identity_; }
  // Whether every position has its place on the target grid.
  bool exact() const { return whole_[0] && whole_[1] && whole_[2]; }

  // The nearest position on the target grid; clamped to int32.
  glm::ivec3 operator()(const glm::ivec3& position) const;
  // How far the nearest position is from the true one, world units, largest axis.
  double rounding(const glm::ivec3& position) const;

 private:
  bool identity_ = true;
  glm::bvec3 whole_{true};  // axes on which the target is a whole multiple plus a whole number
  glm::dvec3 factor_{1.0};
  glm::dvec3 shift_{0.0};
  glm::dvec3 to_scale_{1.0};
};

}  // namespace stipple
