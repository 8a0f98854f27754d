// What is certainly hidden: the farthest depth under each tile of a finished frame.
#pragma once

#include <array>
#include <cstdint>

#include "render/frame/feedback_target.h"
#include "render/gpu/buffer.h"
#include "render/gpu/program.h"

namespace stipple {

// Level k has a value for each tile of 2^(k+1) pixels squared: near / distance of what is farthest there, 0 where a
// pixel of it shows nothing. The last level has at most 8 tiles along each axis.
class DepthPyramid {
 public:
  static constexpr std::size_t kMostLevels = 16;
  struct Level {
    std::uint32_t first = 0;  // place of its first value
    std::uint32_t width = 0;
    std::uint32_t height = 0;
    std::uint32_t padding = 0;
  };

  DepthPyramid();

  // Reads a finished frame.
  void build(const FeedbackTarget& frame);
  // 0 before build().
  std::size_t levels() const { return levels_; }
  const std::array<Level, kMostLevels>& level_table() const { return table_; }
  const GpuBuffer& values() const { return values_; }

 private:
  void resize(const glm::ivec2& size);

  Program from_image_;
  Program from_attachment_;
  Program from_level_;
  glm::ivec2 size_{0};
  std::array<Level, kMostLevels> table_{};
  std::size_t levels_ = 0;
  GpuBuffer values_;
};

}  // namespace stipple
