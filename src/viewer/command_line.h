// The command that renders what the window shows, without a window.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "render/frame/camera.h"
#include "render/frame/eye_dome.h"
#include "render/frame/point_size.h"
#include "render/store/colorize.h"

namespace stipple {

struct RenderCommand {
  std::vector<std::string> inputs;
  std::string mode;
  std::string raster;
  Camera camera;
  glm::ivec2 size{0};       // for each eye
  double eyes_apart = 0.0;  // 0: there is one
  ColorMap colors;
  PointSize point_size;
  std::uint32_t background = 0;
  std::optional<EyeDomeOptions> shading{};
};

// For a shell. Numbers are written so that they are read back as the same doubles.
std::string text_of(const RenderCommand& command);

// One word of a shell, quoted where it has to be.
std::string quoted(const std::string& word);

}  // namespace stipple
