// An octree on disk: what a view asks for is read by I/O threads, nothing else ever is.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "octree/select/frustum.h"
#include "octree/store/tree_store.h"
#include "render/store/colorize.h"
#include "render/store/known_tree.h"
#include "render/store/point_supply.h"

namespace stipple {

// Holds that part of the hierarchy that views have come to, and of the points only those that are under way: at most
// read_ahead() of them, and those of the frame being drawn. Stable ids are those of first_id_of().
class TreeSupply final : public PointSupply {
 public:
  // A cluster of a node in sight; the whole node where the tree knows no clusters.
  struct Part {
    std::uint32_t node;
    std::uint32_t first;  // point of the node
    GridBox box;          // holds all its points
  };

  // `bytes_before`: of what was read from the store so far, what bytes_read() leaves out.
  TreeSupply(std::shared_ptr<const TreeStore> store, ColorMap colors, std::uint64_t bytes_before = 0,
             DensityEstimate density = DensityEstimate::box_count);
  ~TreeSupply() override;
  TreeSupply(const TreeSupply&) = delete;
  TreeSupply& operator=(const TreeSupply&) = delete;

  std::vector<VisibleCluster> visible(const View& view) override;
  std::vector<VisibleCluster> discovered() override;
  bool searching() const override { return asked_ > 0; }
  GridBox box(std::uint32_t handle) const override { return parts_[handle].box; }
  std::size_t visible_nodes() const override { return visible_nodes_; }
  void request(std::uint32_t handle, std::uint32_t first, std::uint32_t count, bool one_pixel) override;
  std::vector<PointPiece> collect(std::uint32_t most) override;
  std::uint64_t points_under_way() const override;
  std::uint64_t read_ahead(std::uint32_t budget) const override { return 3ull * budget; }
  std::uint64_t bytes_read() const override { return store_->bytes_read() - bytes_before_; }
  Unread unread() const override;
  // What a handle of the current view stands for; nodes keep their numbers from view to view.
  const Part& part(std::uint32_t handle) const { return parts_[handle]; }
  const StoredNode& node(std::uint32_t number) const { return tree_.node(number); }

  // How far apart points of a node are on the screen at this distance from the eye: spacing over distance.
  double projected_spacing(std::uint32_t node, double distance) const;

  // Pieces of the hierarchy that were read after the first.
  std::uint64_t pieces_read() const { return tree_.pieces(); }

 private:
  struct Request {
    StoredNode node;
    std::uint32_t first;
    std::uint32_t count;
    bool one_pixel;
    std::uint64_t view;  // which call of visible() it belongs to
    int tries = 0;       // that failed so far
  };
  struct Arrival {
    std::vector<PackedPoint> points;
    std::uint32_t first_id = 0;
    std::uint32_t given = 0;  // of them, by collect()
    bool one_pixel = false;
  };
  void ask(const std::vector<KnownTree::Sight>& unknown);
  void append_clusters(const std::vector<KnownTree::Sight>& seen, std::vector<VisibleCluster>& clusters);
  void append_clusters(const KnownTree::Sight& sight, std::vector<VisibleCluster>& clusters);
  void forget_queue();
  void work(bool looks_first);
  void do_lookup(std::unique_lock<std::mutex>& lock);
  void do_request(std::unique_lock<std::mutex>& lock);
  Arrival read(const Request& request) const;

  std::shared_ptr<const TreeStore> store_;
  ColorMap colors_;
  std::uint64_t bytes_before_;
  std::vector<std::size_t> attributes_;  // that the colour needs
  KnownTree tree_;
  std::size_t asked_ = 0;  // lookups that discovered() has not seen yet
  View view_{};            // the current one
  Frustum frustum_{};
  std::vector<Part> parts_;  // of this view; handles are indices
  std::size_t visible_nodes_ = 0;
  std::vector<Arrival> given_;  // what the last collect() handed out

  // Guarded by mutex_
  mutable std::mutex mutex_;
  std::condition_variable work_ready_;
  std::condition_variable arrived_;
  std::deque<KnownTree::Lookup> lookups_;
  std::deque<KnownTree::Lookup> found_;
  std::deque<Request> queue_;
  std::deque<Arrival> arrivals_;
  Unread unread_;  // of the current view
  std::uint64_t view_number_ = 0;
  std::size_t under_way_ = 0;           // requests queued or being read for the current view
  std::uint64_t points_under_way_ = 0;  // those, and what has arrived and is not collected
  std::size_t looking_up_ = 0;          // lookups queued or under way
  bool stop_ = false;

  std::vector<std::thread> threads_;
};

}  // namespace stipple
