// Points from a table: positions on a grid, attributes with the names and types that all sources share.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/read/table/point_table.h"
#include "octree/read/table/table_color.h"
#include "octree/read/table/table_meaning.h"

namespace stipple {

class TableSource : public PointSource {
 public:
  // `info` has path, format, version, encoding and warnings; the rest is found out by reading all positions, on all
  // cores. Points whose position is not finite, or beyond kLargestCoordinate, are counted in dropped_points and left
  // out; a warning says so, and another one how far the grid moves positions where it does. Throws Error when the
  // points have no x or y.
  TableSource(std::unique_ptr<const PointTable> table, SourceInfo info);

  const SourceInfo& info() const override { return info_; }

  // A batch a block of the table, begun in file order; ids count the points that are left. Memory: a few MiB a core.
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override;

 private:
  struct Block {
    std::uint64_t first = 0;   // id of its first point
    std::uint32_t points = 0;  // that are left
  };
  struct Workspace;

  void scan();
  void fill_batch(std::size_t block, std::span<const std::size_t> attributes, Workspace& workspace) const;

  std::unique_ptr<const PointTable> table_;
  TableMeaning meaning_;
  SourceInfo info_;
  ColorDepth depth_ = ColorDepth::byte;
  std::vector<Block> blocks_;
};

}  // namespace stipple
