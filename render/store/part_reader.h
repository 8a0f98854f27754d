// Parts of a tree's nodes, read and cut into clusters by I/O threads.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <exception>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

#include "octree/store/tree_store.h"
#include "render/store/cluster_pool.h"
#include "render/store/colorize.h"

namespace stipple {

// A part of a node in a number: what the caller knows the node by, and the part's first point.
using PartKey = std::uint64_t;
inline PartKey part_key(std::uint32_t node, std::uint32_t first) {
  return PartKey{node} << 32 | first;
}
inline std::uint32_t node_of(PartKey key) {
  return static_cast<std::uint32_t>(key >> 32);
}
inline std::uint32_t first_of(PartKey key) {
  return static_cast<std::uint32_t>(key);
}

class PartReader {
 public:
  struct Request {
    PartKey key = 0;
    StoredNode node;
    std::uint32_t first = 0;  // point of the node
    std::uint32_t count = 0;
    int tries = 0;  // that failed so far
  };
  struct Part {
    Request request;
    SlottedPoints points;  // none where reading failed, kReadTries times
    std::exception_ptr failure{};
  };

  // `root_edge`: see cut_clusters(); `all_attributes`: see DatasetNeeds.
  PartReader(std::shared_ptr<const TreeStore> store, ColorMap colors, double root_edge, bool all_attributes = false);
  // Waits for the reads that have begun.
  ~PartReader();
  PartReader(const PartReader&) = delete;
  PartReader& operator=(const PartReader&) = delete;

  void request(Request request);
  // Takes back what no thread has begun to read.
  std::vector<Request> cancel();
  // Parts that have arrived, in the order they did. While some are under way and none has arrived, waits for a moment
  // when asked to.
  std::vector<Part> collect(bool patient);
  // Requested and not collected.
  std::uint64_t points_under_way() const { return points_under_way_; }

 private:
  void work();
  SlottedPoints read(const Request& request) const;

  std::shared_ptr<const TreeStore> store_;
  ColorMap colors_;
  double root_edge_;
  std::vector<std::size_t> attributes_;  // to read: first those that the colour needs
  std::uint64_t points_under_way_ = 0;

  std::mutex mutex_;
  std::condition_variable work_ready_;
  std::condition_variable arrived_;
  std::deque<Request> queue_;
  std::vector<Part> parts_;
  bool stop_ = false;

  std::vector<std::thread> threads_;
};

}  // namespace stipple
