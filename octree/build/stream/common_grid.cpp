#include "octree/build/stream/common_grid.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "octree/cloud/grid_fit.h"

namespace stipple {
namespace {

// Offsets and scales are decimal numbers stated as doubles: their quotients are whole only up to this part of a step.
constexpr double kNoise = 1e-4;
// Of the quotient of two scales.
constexpr double kFactorNoise = 1e-9;
// A common divisor so much finer than the finest scale is noise that was taken for a number.
constexpr double kFinestDivisor = 1e-3;

bool near_whole(double value) {
  return std::abs(value - std::round(value)) < kNoise;
}

// Euclid's algorithm for lengths, each of them a whole number of steps of at least `finest`; 0 when there is no such.
double common_divisor(double a, double b, double finest) {
  while (b > finest * 0.5) {
    double rest = std::abs(std::remainder(a, b));
    if (rest < kNoise * b) rest = 0.0;
    a = b;
    b = rest;
    if (b == 0.0) return a;
  }
  return 0.0;
}

// The scale of one axis on which all sources are exact, or 0.
double exact_scale(std::span<const GriddedBox> sources, int axis) {
  double scale = sources.front().grid.scale[axis];
  double finest = scale;
  for (const GriddedBox& source : sources) finest = std::min(finest, source.grid.scale[axis]);
  for (const GriddedBox& source : sources) {
    const double apart = std::abs(source.grid.offset[axis] - sources.front().grid.offset[axis]);
    for (const double length : {source.grid.scale[axis], apart}) {
      if (length == 0.0 || near_whole(length / scale)) continue;
      scale = common_divisor(std::max(length, scale), std::min(length, scale), finest * kFinestDivisor);
      if (scale == 0.0) return 0.0;
    }
  }
  return scale;
}

AxisRange world_range(std::span<const GriddedBox> sources, int axis) {
  AxisRange range{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
  for (const GriddedBox& source : sources) {
    if (source.box.empty()) continue;
    const WorldBox box = world_box(source.grid, source.box);
    range.min = std::min(range.min, box.min[axis]);
    range.max = std::max(range.max, box.max[axis]);
  }
  if (range.min > range.max) range = {sources.front().grid.offset[axis], sources.front().grid.offset[axis]};
  return range;
}

}  // namespace

Grid common_grid(std::span<const GriddedBox> sources) {
  if (sources.empty()) return {};
  const Grid& first = sources.front().grid;
  if (std::ranges::all_of(sources, [&](const GriddedBox& source) {
        return source.grid.offset == first.offset && source.grid.scale == first.scale;
      }))
    return first;
  Grid grid;
  for (int axis = 0; axis < 3; ++axis) {
    const AxisRange range = world_range(sources, axis);
    double scale = exact_scale(sources, axis);
    if (scale == 0.0 || (range.max - range.min) / scale > kGridSteps) {
      double finest = first.scale[axis];
      for (const GriddedBox& source : sources) finest = std::min(finest, source.grid.scale[axis]);
      scale = fitting_scale(finest, range.max - range.min);
    }
    grid.scale[axis] = scale;
    grid.offset[axis] = fitting_offset(first.offset[axis], scale, range);
  }
  return grid;
}

GridTransform::GridTransform(const Grid& from, const Grid& to)
    : factor_(from.scale / to.scale), shift_((from.offset - to.offset) / to.scale), to_scale_(to.scale) {
  for (int axis = 0; axis < 3; ++axis) {
    whole_[axis] = std::abs(factor_[axis] - std::round(factor_[axis])) < kFactorNoise * factor_[axis] &&
                   factor_[axis] > 0.5 && near_whole(shift_[axis]);
    if (whole_[axis]) {
      factor_[axis] = std::round(factor_[axis]);
      shift_[axis] = std::round(shift_[axis]);
    }
    identity_ = identity_ && whole_[axis] && factor_[axis] == 1.0 && shift_[axis] == 0.0;
  }
}

glm::ivec3 GridTransform::operator()(const glm::ivec3& position) const {
  const glm::dvec3 exact = glm::dvec3(position) * factor_ + shift_;
  constexpr double kLow = std::numeric_limits<std::int32_t>::min();
  constexpr double kHigh = std::numeric_limits<std::int32_t>::max();
  return glm::ivec3(glm::clamp(glm::round(exact), glm::dvec3(kLow), glm::dvec3(kHigh)));
}

double GridTransform::rounding(const glm::ivec3& position) const {
  const glm::dvec3 exact = glm::dvec3(position) * factor_ + shift_;
  const glm::dvec3 off = glm::abs(exact - glm::dvec3((*this)(position))) * to_scale_;
  return std::max({off.x, off.y, off.z});
}

}  // namespace stipple
