#include "src/viewer/flight.h"

#include <utility>

namespace stipple {
namespace {

bool same(const Camera& a, const Camera& b) {
  return a.eye == b.eye && a.target == b.target && a.up == b.up && a.fov_deg == b.fov_deg;
}

}  // namespace

void Flight::record(double now) {
  stop();
  recorded_ = {.name = "recorded", .keys = {}};
  record_start_ = now;
}

void Flight::see(const Camera& camera, double now) {
  if (!records()) return;
  auto& keys = recorded_.keys;
  const double seconds = now - *record_start_;
  if (keys.empty()) {
    keys.push_back({0.0, camera});
    return;
  }
  if (same(keys.back().camera, camera)) return;
  // The curve between two keys depends on their neighbours: a pause has some of its own, so that it stays one
  if (const TimedCamera last = keys.back(); seconds - last.seconds > 4.0 * kInterval)
    for (const double key : {last.seconds + kInterval, seconds - 2.0 * kInterval, seconds - kInterval})
      keys.push_back({key, last.camera});
  if (seconds - keys.back().seconds >= kInterval) keys.push_back({seconds, camera});
}

bool Flight::finish() {
  record_start_.reset();
  if (recorded_.keys.size() < 2) return false;
  path_ = std::move(recorded_);
  return true;
}

void Flight::replay(double now) {
  if (path_) replay_start_ = now;
}

Camera Flight::camera(double now) {
  const double seconds = path_->start() + now - *replay_start_;
  if (seconds >= path_->start() + path_->duration()) stop();
  return camera_at(*path_, seconds);
}

}  // namespace stipple
