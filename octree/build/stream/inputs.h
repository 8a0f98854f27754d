// Several sources read as one: one grid, one schema, records ready for the disk.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "octree/build/stream/attribute_stats.h"
#include "octree/build/stream/common_grid.h"
#include "octree/build/stream/monitor.h"
#include "octree/build/stream/record.h"
#include "octree/cloud/merged_schema.h"
#include "octree/cloud/source.h"
#include "octree/core/error.h"
#include "octree/store/tree_store.h"

namespace stipple {

using PositionConsumer = std::function<void(std::span<const glm::ivec3>)>;
using RecordConsumer = std::function<void(std::span<const std::byte>)>;

class Inputs {
 public:
  // Bounds are those that the sources state until look() has seen the points.
  Inputs(std::span<const std::unique_ptr<PointSource>> sources, BuildMonitor& monitor);

  const Schema& schema() const { return schema_; }
  std::size_t record_bytes() const { return record_bytes_; }
  std::uint64_t point_count() const { return point_count_; }

  // As far as known.
  const Grid& grid() const { return grid_; }
  const GridBox& bounds() const { return bounds_; }
  // Of the bounds, in world units; zeros where there are no points.
  AttributeRange position_range() const;
  // Of the positions that the last reading gave; 0: every position was exact.
  double largest_rounding() const { return largest_rounding_; }

  // Gives `consume`, from several threads at once, all positions on the grid. Returns false when grid or bounds proved
  // wrong, which headers may be; they are right then, and what was consumed was not. Throws Error when sources deliver
  // other numbers of points than they state.
  bool read_positions(const PositionConsumer& consume);

  // Gives `consume`, from several threads at once, all records in batches of whole records, and `stats` all attributes.
  void read_records(AttributeStats& stats, const RecordConsumer& consume);

 private:
  struct Source {
    const PointSource* points;
    std::vector<std::size_t> attributes;  // of the merged schema: where each of its own goes
    GridBox box;                          // on its own grid
    double bytes_per_point;

    std::uint64_t bytes_of(const PointBatch& batch) const {
      return static_cast<std::uint64_t>(static_cast<double>(batch.positions.size()) * bytes_per_point);
    }
  };

  void choose_grid();
  void for_each_source(const std::function<void(std::size_t)>& read) const;

  std::vector<Source> sources_;
  BuildMonitor& monitor_;
  Schema schema_;
  std::size_t record_bytes_ = 0;
  std::uint64_t point_count_ = 0;
  Grid grid_;
  GridBox bounds_;
  double largest_rounding_ = 0.0;
};

// Has `read` read all positions, which says whether grid and bounds were right meanwhile, until they were. Throws Error
// when they never are.
void read_until_right(const std::function<bool()>& read);

// What to throw where a file gives other points than before.
Error changed_while_read();

}  // namespace stipple
