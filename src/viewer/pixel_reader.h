// Which point a place of the picture shows, found out without waiting for the GPU.
#pragma once

#include <epoxy/gl.h>

#include <cstdint>
#include <glm/glm.hpp>
#include <optional>

#include "render/frame/feedback_target.h"
#include "render/gpu/buffer.h"

namespace stipple {

// The covered pixel nearest to the place that was asked for.
struct PickedPixel {
  glm::ivec3 position;  // on the grid
  std::uint32_t id;
  std::uint32_t rgba;
  glm::ivec2 pixel;
};

class PixelReader {
 public:
  // Pixels to each side that are searched.
  static constexpr int kReach = 8;

  PixelReader();
  ~PixelReader();
  PixelReader(const PixelReader&) = delete;
  PixelReader& operator=(const PixelReader&) = delete;

  // Asks for the pixels around this one. What was asked before and has not come is forgotten.
  void ask(const FeedbackTarget& frame, const glm::ivec2& pixel);
  bool waiting() const { return fence_ != nullptr; }
  // Whether the answer is there; then `answer` is set, empty where nothing was drawn near the place.
  bool answered(std::optional<PickedPixel>& answer);

 private:
  GpuBuffer points_;
  GpuBuffer ids_;
  GLsync fence_ = nullptr;
  glm::ivec2 first_{0};
  glm::ivec2 size_{0};
  glm::ivec2 place_{0};
};

}  // namespace stipple
