// An octree on disk: what a view asks for is read by I/O threads, nothing else ever is.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

#include "octree/select/frustum.h"
#include "octree/store/tree_store.h"
#include "render/store/colorize.h"
#include "render/store/point_supply.h"

namespace stipple {

// Holds the hierarchy, and of the points only those that are under way: at most read_ahead() of them, and those of the
// frame being drawn. Stable ids count points in store order.
class TreeSupply final : public PointSupply {
 public:
  TreeSupply(std::shared_ptr<const TreeStore> store, ColorMap colors);
  ~TreeSupply() override;
  TreeSupply(const TreeSupply&) = delete;
  TreeSupply& operator=(const TreeSupply&) = delete;

  std::vector<VisibleCluster> visible(const View& view) override;
  std::size_t visible_nodes() const override { return visible_nodes_; }
  void request(std::uint32_t handle, std::uint32_t first, std::uint32_t count) override;
  std::vector<PointPiece> collect(std::uint32_t most) override;
  std::uint64_t read_ahead(std::uint32_t budget) const override { return 3ull * budget; }
  std::uint64_t bytes_read() const override;

 private:
  // A cluster of a node in sight; the whole node where the tree knows no clusters.
  struct Part {
    std::uint32_t node;
    std::uint32_t first;  // point of the node
  };
  struct Request {
    Part part;
    std::uint32_t count;
    std::uint64_t view;  // which call of visible() it belongs to
  };
  struct Arrival {
    std::vector<PackedPoint> points;
    std::uint32_t first_id = 0;
    std::uint32_t given = 0;  // of them, by collect()
  };

  void append_clusters(std::uint32_t node, const View& view, const Frustum& frustum,
                       std::vector<VisibleCluster>& clusters);
  void work();
  Arrival read(const Request& request) const;

  std::shared_ptr<const TreeStore> store_;
  ColorMap colors_;
  std::vector<std::size_t> attributes_;                     // that the colour needs
  std::vector<StoredNode> nodes_;                           // with points, in store order
  std::vector<std::uint32_t> first_id_;                     // of each
  std::unordered_map<std::uint32_t, NodeDetails> details_;  // of nodes that were in sight
  std::vector<Part> parts_;                                 // of this view; handles are indices
  std::size_t visible_nodes_ = 0;
  std::vector<Arrival> given_;  // what the last collect() handed out

  // Guarded by mutex_
  mutable std::mutex mutex_;
  std::condition_variable work_ready_;
  std::condition_variable arrived_;
  std::deque<Request> queue_;
  std::deque<Arrival> arrivals_;
  std::exception_ptr failure_;
  std::uint64_t view_ = 0;
  std::uint64_t bytes_read_ = 0;
  std::size_t under_way_ = 0;  // requests queued or being read for the current view
  bool stop_ = false;

  std::vector<std::thread> threads_;
};

}  // namespace stipple
