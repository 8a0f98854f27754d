// From columns to records.
#pragma once

#include <span>
#include <vector>

#include "octree/build/stream/attribute_stats.h"
#include "octree/build/stream/common_grid.h"
#include "octree/cloud/source.h"

namespace stipple {

// Turns batches of one source into records of a common schema on a common grid.
class RowWriter {
 public:
  // `places[a]`: where attribute a of `own` stands in `common`. An attribute that differs there is a double.
  RowWriter(const Schema& own, std::span<const std::size_t> places, const Schema& common,
            const GridTransform& transform);

  // `batch` has all columns of the source. Resizes `records`; adds all values to `stats`, which is of the common
  // schema.
  void write(const PointBatch& batch, Buffer<std::byte>& records, AttributeStats& stats) const;

 private:
  struct Target {
    std::size_t index = 0;   // in the common schema
    std::size_t offset = 0;  // in the record
    bool convert = false;
    Attribute attribute;
  };

  GridTransform transform_;
  std::vector<Target> targets_;  // of the source's attributes
  std::vector<Target> missing_;  // attributes that the source lacks
  std::size_t record_bytes_ = 0;
};

}  // namespace stipple
