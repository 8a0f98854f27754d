#include "src/command/build_watch.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <string>

#include "src/json/json.h"
#include "src/run/build_estimate.h"

namespace stipple {
namespace {

std::atomic<BuildMonitor*> stopped_by_signal{nullptr};

extern "C" void stop_build(int) {
  if (BuildMonitor* monitor = stopped_by_signal.load()) monitor->stop();
}

void on_interrupt(void (*handler)(int)) {
  struct sigaction action {};
  action.sa_handler = handler;
  ::sigaction(SIGINT, &action, nullptr);
  ::sigaction(SIGTERM, &action, nullptr);
}

void print_json_line(const BuildProgress& progress, double seconds) {
  const BuildEstimate now = estimate(progress, seconds);
  const Json line{
      {"phase", name_of(progress.phase)},        {"points", progress.points}, {"counted", progress.counted},
      {"distributed", progress.distributed},     {"built", progress.built},   {"bytes_read", progress.bytes_read},
      {"bytes_written", progress.bytes_written}, {"seconds", seconds},        {"points_per_second", now.rate},
      {"seconds_left", now.seconds_left}};
  fmt::print("{}\n", line.dump());
  std::fflush(stdout);
}

void print_terminal_line(const BuildProgress& progress, double seconds) {
  const BuildEstimate now = estimate(progress, seconds);
  fmt::print(stderr, "\r{:<12} {:3.0f} %  {:5.1f} M points/s  {:.2f} GB read  {:.2f} GB written  {:.0f} s left\x1b[K",
             name_of(progress.phase), 100.0 * share_done(progress), now.rate * 1e-6,
             static_cast<double>(progress.bytes_read) * 1e-9, static_cast<double>(progress.bytes_written) * 1e-9,
             now.seconds_left);
}

}  // namespace

StopOnSignal::StopOnSignal(BuildMonitor& monitor) {
  stopped_by_signal = &monitor;
  on_interrupt(stop_build);
}

StopOnSignal::~StopOnSignal() {
  on_interrupt(SIG_DFL);
  stopped_by_signal = nullptr;
}

BuildWatch::BuildWatch(const BuildMonitor& monitor, bool json) : monitor_(monitor), json_(json) {
  if (json_ || ::isatty(STDERR_FILENO)) thread_ = std::thread([this] { show_until_done(); });
}

BuildWatch::~BuildWatch() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    done_ = true;
  }
  wake_.notify_one();
  thread_.join();
  if (!json_) fmt::print(stderr, "\r\x1b[K");
}

void BuildWatch::show_until_done() {
  const auto interval = std::chrono::milliseconds(json_ ? 1000 : 200);
  std::unique_lock lock(mutex_);
  while (!wake_.wait_for(lock, interval, [this] { return done_; })) {
    const double seconds = stopwatch_.seconds();
    const BuildProgress progress = monitor_.progress();
    if (json_)
      print_json_line(progress, seconds);
    else
      print_terminal_line(progress, seconds);
  }
}

}  // namespace stipple
