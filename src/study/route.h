// Where the camera stands in a study, frame by frame.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "render/frame/camera.h"
#include "src/study/regime.h"

namespace stipple {

// A view, which is a single one, or a path.
struct Route {
  std::string name;
  std::vector<View> views;
  std::vector<Regime> regimes;     // to be studied on it
  std::optional<View> jumps_from;  // of a view: the other one
  double target_ms = 0.0;          // for a frame; 0: none

  bool is_path() const { return !of_views(regimes.front()); }
};

}  // namespace stipple
