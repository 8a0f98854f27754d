// A cloud and its octree in main memory: everything is there at once.
#pragma once

#include "octree/tree/octree.h"
#include "render/frame/point_set.h"
#include "render/store/point_supply.h"

namespace stipple {

class MemorySupply final : public PointSupply {
 public:
  // `points` in store order of the octree. Both must outlive the supply.
  MemorySupply(const PointSet& points, const Octree& octree, DensityEstimate density = DensityEstimate::box_count)
      : PointSupply(density), points_(&points), octree_(octree) {}

  std::vector<VisibleCluster> visible(const View& view) override;
  GridBox box(std::uint32_t handle) const override { return octree_.clusters[handle].box; }
  std::size_t visible_nodes() const override { return visible_nodes_; }
  void request(std::uint32_t handle, std::uint32_t first, std::uint32_t count, bool one_pixel) override;
  std::vector<PointPiece> collect(std::uint32_t most) override;
  std::uint64_t points_under_way() const override { return points_under_way_; }
  std::uint64_t read_ahead(std::uint32_t budget) const override { return budget; }
  // They must outlive the supply.
  bool recolor(const PointSet& points) override {
    points_ = &points;
    return true;
  }
  std::uint64_t bytes_read() const override { return bytes_read_; }

 private:
  // Slots in store order.
  struct Stretch {
    std::uint32_t first;
    std::uint32_t count;
    bool one_pixel;
  };
  PointPiece piece(const Stretch& stretch) const;

  const PointSet* points_;
  const Octree& octree_;
  std::vector<Stretch> requested_;
  std::uint64_t points_under_way_ = 0;
  std::size_t visible_nodes_ = 0;
  std::uint64_t bytes_read_ = 0;
};

}  // namespace stipple
