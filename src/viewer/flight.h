// Camera paths: recorded from what is done in the window, and flown again. Pure: time comes in as an argument.
#pragma once

#include <optional>

#include "src/camera/camera_path.h"

namespace stipple {

class Flight {
 public:
  // Seconds between two keys, as long as the camera moves.
  static constexpr double kInterval = 0.1;

  // Recording; what was there before is forgotten with the first camera.
  void record(double now);
  bool records() const { return record_start_.has_value(); }
  // The camera as it is.
  void see(const Camera& camera, double now);
  // The end of recording. False when nothing moved: then the path is as it was before.
  bool finish();

  // The path that replay() flies; none: there is none yet.
  const std::optional<CameraPath>& path() const { return path_; }
  void set_path(const CameraPath& path) { path_ = path; }
  void replay(double now);
  void stop() { replay_start_.reset(); }
  bool replays() const { return replay_start_.has_value(); }
  // Where the replay is; at its end it stops.
  Camera camera(double now);

 private:
  std::optional<CameraPath> path_;
  CameraPath recorded_;
  std::optional<double> record_start_;
  std::optional<double> replay_start_;
};

}  // namespace stipple
