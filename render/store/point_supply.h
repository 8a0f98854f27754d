// Where the hierarchical methods get clusters and their points from: main memory, or a tree on disk.
#pragma once

#include <cstdint>
#include <vector>

#include "octree/cloud/grid.h"
#include "octree/select/density.h"
#include "octree/tree/octree.h"
#include "render/frame/camera.h"
#include "render/frame/point_size.h"
#include "render/store/stream_buffer.h"
#include "render/store/unread.h"

namespace stipple {

// A cluster that a view may see.
struct VisibleCluster {
  std::uint32_t handle = 0;  // what the supply knows it by; valid until the next call of visible()
  std::uint32_t count = 0;   // points
  double pixels = 0.0;       // estimated to be covered by all of them
  double distance = 0.0;     // of its node's nearest place from the eye, world units
  SplatRange splats = SplatRange::far;
};

class PointSupply {
 public:
  explicit PointSupply(DensityEstimate density) : density_(density) {}
  virtual ~PointSupply() = default;

  // How large points are drawn from the next call of visible() on.
  void set_point_size(const PointSize& point_size) { point_size_ = point_size; }
  // The clusters with points that `view` may see, front to back, as far as they are known without waiting. Forgets what
  // was requested before.
  virtual std::vector<VisibleCluster> visible(const View& view) = 0;
  // Those that became known since, front to back.
  virtual std::vector<VisibleCluster> discovered() { return {}; }
  // Whether discovered() may have more to give, now or later.
  virtual bool searching() const { return false; }
  // Holds all points of a cluster.
  virtual GridBox box(std::uint32_t handle) const = 0;
  // Nodes those clusters belong to.
  virtual std::size_t visible_nodes() const = 0;

  // Asks for points [first, first + count) of a cluster. `one_pixel` is for their pieces.
  virtual void request(std::uint32_t handle, std::uint32_t first, std::uint32_t count, bool one_pixel) = 0;
  // Requested points that have arrived, `most` at most, each given once; they stay valid until the next call of any
  // function. While requests are under way, or clusters searched for, and none has arrived, waits for a moment before
  // it gives nothing.
  virtual std::vector<PointPiece> collect(std::uint32_t most) = 0;
  // Points requested that are still to come.
  virtual std::uint64_t points_under_way() const = 0;
  // Points to have under way so that collect() seldom waits, for a frame of `budget` points.
  virtual std::uint64_t read_ahead(std::uint32_t budget) const = 0;

  // The same points in the same order, in other colours, take the place of those that it gives, also of what is
  // requested already. False where it reads its points from disk.
  virtual bool recolor(const PointSet&) { return false; }

  // Bytes read from disk or main memory so far.
  virtual std::uint64_t bytes_read() const = 0;
  // See Method::unread().
  virtual Unread unread() const { return {}; }

 protected:
  // Pixels that the points of a cluster, whose box in the world is `box`, are estimated to cover.
  double estimate(const Cluster& cluster, const WorldBox& box, double root_edge, const View& view) const;

  PointSize point_size_;

 private:
  DensityEstimate density_;
};

}  // namespace stipple
