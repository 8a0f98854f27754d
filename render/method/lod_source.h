// Where mode lod gets its nodes from: a tree in memory, or one on disk.
#pragma once

#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <unordered_map>
#include <unordered_set>
#include <vector>

#include "render/method/method.h"
#include "render/store/cluster_pool.h"
#include "render/store/gpu_cloud.h"
#include "render/store/part_reader.h"
#include "render/store/tree_supply.h"

namespace stipple {

class LodSource {
 public:
  // A cluster of a node in sight, or the node.
  struct Part {
    PartKey key = 0;
    std::uint32_t count = 0;  // points
    double urgency = 0.0;     // the distance of its points from each other over that from the eye
    SplatRange splats = SplatRange::far;
  };

  virtual ~LodSource() = default;

  // How large points are drawn from the next call of visible() on.
  virtual void set_point_size(const PointSize& point_size) { point_size_ = point_size; }
  // The parts that a new view may see, as far as they are known.
  virtual std::vector<Part> visible(const View& view) = 0;
  // Those that became known since.
  virtual std::vector<Part> discovered() = 0;
  virtual bool searching() const = 0;
  // Appends the items that draw those of `parts` that are on the GPU, and the number of their points, and asks for the
  // others; true when there are none that may still come.
  virtual bool draw(std::span<const Part> parts, Selection& selection) = 0;
  virtual std::uint64_t bytes_read() const { return 0; }
  // See Method::unread().
  virtual Unread unread() const { return {}; }
  // See Method::colored().
  virtual std::optional<std::vector<ColoredPoints>> colored() const { return std::nullopt; }
  // What one draw() has room for, in slots of SlottedPoints.
  virtual std::uint64_t room() const { return std::numeric_limits<std::uint64_t>::max(); }

 protected:
  // See PointRange.
  bool one_pixel(const Part& part) const { return point_size_.pixels == 1.0 && part.splats == SplatRange::far; }

  PointSize point_size_;
};

// All points lie on the GPU.
class MemoryLod final : public LodSource {
 public:
  // Both must outlive it; points stand in the octree's store order.
  MemoryLod(const PointSet& points, const Octree& octree) : octree_(octree), cloud_(upload_in_order(points)) {}

  std::vector<Part> visible(const View& view) override;
  std::vector<Part> discovered() override { return {}; }
  bool searching() const override { return false; }
  bool draw(std::span<const Part> parts, Selection& selection) override;
  std::optional<std::vector<ColoredPoints>> colored() const override { return colored_points(cloud_); }

 private:
  const Octree& octree_;
  GpuCloud cloud_;
};

// Parts come to a pool on the GPU, and those that were not drawn for longest give way.
class TreeLod final : public LodSource {
 public:
  TreeLod(std::shared_ptr<const TreeStore> store, const ColorMap& colors, std::uint64_t bytes_before,
          std::uint32_t slots);

  void set_point_size(const PointSize& point_size) override {
    LodSource::set_point_size(point_size);
    supply_.set_point_size(point_size);
  }
  std::vector<Part> visible(const View& view) override;
  std::vector<Part> discovered() override { return parts_of(supply_.discovered()); }
  bool searching() const override { return supply_.searching(); }
  bool draw(std::span<const Part> parts, Selection& selection) override;
  std::uint64_t bytes_read() const override { return supply_.bytes_read(); }
  Unread unread() const override;
  std::uint64_t room() const override { return pool_.table().capacity; }

 private:
  struct Resident {
    std::vector<ClusterRun> runs;
    std::uint64_t frame = 0;  // the last that wanted it
  };

  std::vector<Part> parts_of(const std::vector<VisibleCluster>& clusters) const;
  void request(const Part& part);
  void receive(bool patient);
  void put(PartReader::Part& part);

  std::shared_ptr<const TreeStore> store_;
  TreeSupply supply_;
  PartReader reader_;
  ClusterPool pool_;
  std::uint64_t frame_ = 0;
  std::unordered_map<PartKey, Resident> residents_;
  std::unordered_set<PartKey> loading_;
  bool new_view_ = true;                     // and no frame of it drawn
  std::unordered_set<PartKey> cannot_read_;  // for this view
  Unread unread_;                            // of those
};

}  // namespace stipple
