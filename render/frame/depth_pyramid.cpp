#include "render/frame/depth_pyramid.h"

#include <algorithm>

namespace stipple {
namespace {

constexpr std::uint32_t kTilesOfTheLast = 8;

}  // namespace

DepthPyramid::DepthPyramid()
    : from_image_(Program::compute("depth_pyramid.glsl", {{"FROM_IMAGE"}})),
      from_attachment_(Program::compute("depth_pyramid.glsl", {{"FROM_ATTACHMENT"}})),
      from_level_(Program::compute("depth_pyramid.glsl")),
      values_(sizeof(float)) {}

void DepthPyramid::resize(const glm::ivec2& size) {
  size_ = size;
  levels_ = 0;
  std::uint32_t first = 0;
  auto width = static_cast<std::uint32_t>(size.x);
  auto height = static_cast<std::uint32_t>(size.y);
  do {
    width = (width + 1) / 2;
    height = (height + 1) / 2;
    table_[levels_++] = {first, width, height, 0};
    first += width * height;
  } while (std::max(width, height) > kTilesOfTheLast && levels_ < kMostLevels);
  values_ = GpuBuffer(first * sizeof(float));
}

void DepthPyramid::build(const FeedbackTarget& frame) {
  if (frame.size() != size_) resize(frame.size());
  values_.bind_storage(3);
  for (std::size_t k = 0; k < levels_; ++k) {
    const Level& level = table_[k];
    glm::ivec2 below = size_;
    if (k == 0) {
      (frame.depth_storage() == DepthStorage::image ? from_image_ : from_attachment_).use();
      frame.depth().bind(0);
    } else {
      const Level& finer = table_[k - 1];
      below = glm::ivec2(finer.width, finer.height);
      from_level_.use();
      glUniform3ui(1, finer.first, finer.width, finer.height);
    }
    glUniform3ui(0, level.first, level.width, level.height);
    glUniform2i(2, below.x, below.y);
    dispatch_pixels(glm::ivec2(level.width, level.height));
    glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT);
  }
}

}  // namespace stipple
