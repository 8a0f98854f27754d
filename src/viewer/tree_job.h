// An octree on disk, built in the background.
#pragma once

#include <atomic>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "octree/build/stream/monitor.h"
#include "octree/core/stopwatch.h"

namespace stipple {

// One build at a time, on a thread of its own. All functions are for the window's thread.
class TreeJob {
 public:
  struct Status {
    std::string folder;
    BuildProgress progress;
    double seconds = 0.0;  // since it began
  };
  struct Result {
    std::string folder;
    std::string failure;  // empty: the tree is there
    bool cancelled = false;
  };

  // Stops what runs.
  ~TreeJob();
  TreeJob() = default;
  TreeJob(const TreeJob&) = delete;
  TreeJob& operator=(const TreeJob&) = delete;

  // Builds the tree of all these inputs in `folder`, which must not be there, with `memory` bytes at most. None may be
  // running.
  void start(const std::vector<std::string>& inputs, const std::string& folder, std::uint64_t memory);
  bool running() const { return monitor_.has_value(); }
  // Of the build that runs.
  Status status() const;
  // It ends soon, and leaves nothing behind.
  void cancel();
  // Of a build that has ended, once.
  std::optional<Result> take();

 private:
  void work(const std::vector<std::string>& inputs, std::uint64_t memory);

  std::string folder_;
  Stopwatch watch_;
  std::optional<BuildMonitor> monitor_;
  bool cancelled_ = false;
  std::mutex mutex_;
  std::optional<Result> result_;  // guarded by it
  std::thread thread_;
};

}  // namespace stipple
