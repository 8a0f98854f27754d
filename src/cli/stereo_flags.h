// Options of commands that can draw for two eyes.
#pragma once

#include <CLI/App.hpp>
#include <glm/glm.hpp>
#include <string>

#include "render/frame/camera.h"

namespace stipple {

struct StereoFlags {
  bool on = false;
  std::string apart;
};

void add_stereo_flags(CLI::App& command, StereoFlags& flags);

// Throws UsageError where a distance is none, or two pictures of `size` are wider than one may be.
void check(const StereoFlags& flags, const glm::ivec2& size);
// How far apart the eyes are, world units; 0: there is one.
double eyes_apart_of(const StereoFlags& flags, const Camera& camera);

}  // namespace stipple
