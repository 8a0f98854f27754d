#include "octree/build/stream/monitor.h"

#include "octree/core/error.h"

namespace stipple {

std::string_view name_of(BuildPhase phase) {
  static constexpr std::string_view kNames[] = {"counting", "distributing", "building", "finishing"};
  return kNames[static_cast<std::size_t>(phase)];
}

BuildProgress BuildMonitor::progress() const {
  BuildProgress progress;
  progress.phase = phase_;
  progress.points = points_;
  progress.counted = done_[static_cast<std::size_t>(BuildPhase::counting)];
  progress.distributed = done_[static_cast<std::size_t>(BuildPhase::distributing)];
  progress.built = done_[static_cast<std::size_t>(BuildPhase::building)];
  progress.bytes_read = read_;
  progress.bytes_written = written_;
  return progress;
}

void BuildMonitor::add_points(BuildPhase phase, std::uint64_t points) {
  if (stop_.load(std::memory_order_relaxed)) throw Error("the build was interrupted; nothing was left behind");
  done_[static_cast<std::size_t>(phase)].fetch_add(points, std::memory_order_relaxed);
}

}  // namespace stipple
