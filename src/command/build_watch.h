// What is seen of a running build, and how it is interrupted.
#pragma once

#include <condition_variable>
#include <mutex>
#include <thread>

#include "octree/build/stream/monitor.h"
#include "octree/core/stopwatch.h"

namespace stipple {

// While it lives, SIGINT and SIGTERM end the build properly. One at a time.
class StopOnSignal {
 public:
  explicit StopOnSignal(BuildMonitor& monitor);
  ~StopOnSignal();
  StopOnSignal(const StopOnSignal&) = delete;
  StopOnSignal& operator=(const StopOnSignal&) = delete;
};

// While it lives, shows phase, points, rate, bytes and time left: as JSON, a line a second on stdout; else, if stderr
// is a terminal, in one line there.
class BuildWatch {
 public:
  BuildWatch(const BuildMonitor& monitor, bool json);
  ~BuildWatch();
  BuildWatch(const BuildWatch&) = delete;
  BuildWatch& operator=(const BuildWatch&) = delete;

 private:
  void show_until_done();

  const BuildMonitor& monitor_;
  bool json_;
  Stopwatch stopwatch_;
  std::mutex mutex_;
  std::condition_variable wake_;
  bool done_ = false;
  std::thread thread_;  // last: it uses the others
};

}  // namespace stipple
