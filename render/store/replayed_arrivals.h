// A cloud in memory that arrives once more.
#pragma once

#include <vector>

#include "render/store/point_arrivals.h"

namespace stipple {

// Points come in the order of their ids, as a file that is read from front to back gives them, as many as are asked
// for, and in their final colours: equal on any machine.
class ReplayedArrivals final : public PointArrivals {
 public:
  // `dataset` must outlive it, be in memory and have ids 0, 1, ... in any order: throws Error for others, which points
  // of an octree on disk have.
  explicit ReplayedArrivals(const Dataset& dataset);

  std::size_t total() const override { return dataset_.points.size(); }
  std::size_t ready() override { return total() - next_; }
  Batch take(std::size_t most) override;
  std::shared_ptr<const Dataset> whole() override;
  const ColorMap& colors() const override { return dataset_.colors; }

 private:
  const Dataset& dataset_;
  std::vector<std::uint32_t> place_of_;  // of the point with this id; empty: it is the id
  std::uint32_t next_ = 0;               // id
  Buffer<PackedPoint> taken_;
};

}  // namespace stipple
