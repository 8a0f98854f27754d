// Points that come while they are drawn.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>

#include "render/frame/point_set.h"
#include "render/store/dataset.h"

namespace stipple {

class PointArrivals {
 public:
  virtual ~PointArrivals() = default;

  // Points with ids first_id, first_id + 1, ...
  struct Batch {
    std::uint32_t first_id = 0;
    std::span<const PackedPoint> points;
  };

  // How many there will be.
  virtual std::size_t total() const = 0;
  // How many have come and are not taken; more may at any moment. Throws what reading has thrown.
  virtual std::size_t ready() = 0;
  // At most `most` of the points that have come; none when there are none just now. Each point once, in any order.
  // Valid until the next call. Throws what reading has thrown.
  virtual Batch take(std::size_t most) = 0;
  // Once all points are taken, they as a cloud; null before. Its colours are final: those of the batches may differ.
  virtual std::shared_ptr<const Dataset> whole() = 0;
  // By which the batches are coloured. Of no meaning before the first.
  virtual const ColorMap& colors() const = 0;
};

}  // namespace stipple
