// Watching a build from outside, and ending it.
#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>

#include "octree/cloud/grid.h"

namespace stipple {

enum class BuildPhase : std::uint8_t { counting, distributing, building, finishing };

// "counting", ...
std::string_view name_of(BuildPhase phase);

struct BuildProgress {
  BuildPhase phase = BuildPhase::counting;
  std::uint64_t points = 0;       // of the input
  std::uint64_t counted = 0;      // points that each phase is done with
  std::uint64_t distributed = 0;  // may exceed `points` where points are spilled
  std::uint64_t built = 0;
  std::uint64_t bytes_read = 0;     // input, again for each time it is read, and what was spilled
  std::uint64_t bytes_written = 0;  // spilled ones included
};

// A node whose points will not change any more and can be read from octree.bin in the folder of the build.
struct FinishedNode {
  int level = 0;
  glm::uvec3 cell{0};  // of 2^level cells along each axis
  std::uint64_t points = 0;
  std::uint64_t byte_offset = 0;
  std::uint64_t byte_size = 0;
  GridBox box;  // tight
};

// Nodes that were finished together. The file moves when the build is done: an open descriptor stays good.
struct FinishedNodes {
  std::string points_file;
  std::span<const FinishedNode> nodes;
};

// Shared by a build and those who watch it. All functions may be called from any thread.
class BuildMonitor {
 public:
  // Set before the build: called from its threads, several at once. What it throws ends the build.
  std::function<void(const FinishedNodes&)> on_finished;

  BuildProgress progress() const;

  // Makes the build throw Error soon. Safe in a signal handler.
  void stop() noexcept { stop_.store(true, std::memory_order_relaxed); }

  // For the build itself.
  void begin(BuildPhase phase) { phase_ = phase; }
  void set_points(std::uint64_t points) { points_ = points; }
  // Throws Error when the build is to stop.
  void add_points(BuildPhase phase, std::uint64_t points);
  void add_read(std::uint64_t bytes) { read_.fetch_add(bytes, std::memory_order_relaxed); }
  void add_written(std::uint64_t bytes) { written_.fetch_add(bytes, std::memory_order_relaxed); }

 private:
  static_assert(std::atomic<bool>::is_always_lock_free, "stop() is called by signal handlers");
  std::atomic<bool> stop_{false};
  std::atomic<BuildPhase> phase_{BuildPhase::counting};
  std::atomic<std::uint64_t> points_{0};
  std::atomic<std::uint64_t> done_[4]{};
  std::atomic<std::uint64_t> read_{0};
  std::atomic<std::uint64_t> written_{0};
};

}  // namespace stipple
