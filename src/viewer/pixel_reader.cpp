#include "src/viewer/pixel_reader.h"

#include <array>
#include <limits>

namespace stipple {
namespace {

constexpr int kSide = 2 * PixelReader::kReach + 1;
constexpr std::size_t kPixels = static_cast<std::size_t>(kSide) * kSide;

void copy(const Texture2D& texture, GLenum format, GLenum type, const glm::ivec2& first, const glm::ivec2& size,
          const GpuBuffer& to) {
  glBindBuffer(GL_PIXEL_PACK_BUFFER, to.name());
  glGetTextureSubImage(texture.name(), 0, first.x, first.y, 0, size.x, size.y, 1, format, type,
                       static_cast<GLsizei>(to.bytes()), nullptr);
  glBindBuffer(GL_PIXEL_PACK_BUFFER, 0);
}

}  // namespace

PixelReader::PixelReader() : points_(kPixels * sizeof(glm::ivec4)), ids_(kPixels * sizeof(std::uint32_t)) {}

PixelReader::~PixelReader() {
  glDeleteSync(fence_);
}

void PixelReader::ask(const FeedbackTarget& frame, const glm::ivec2& pixel) {
  glDeleteSync(fence_);
  fence_ = nullptr;
  place_ = glm::clamp(pixel, glm::ivec2(0), frame.size() - 1);
  first_ = glm::max(place_ - kReach, 0);
  size_ = glm::min(place_ + kReach + 1, frame.size()) - first_;
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT | GL_PIXEL_BUFFER_BARRIER_BIT);
  copy(frame.points(), GL_RGBA_INTEGER, GL_INT, first_, size_, points_);
  copy(frame.ids(), GL_RED_INTEGER, GL_UNSIGNED_INT, first_, size_, ids_);
  fence_ = glFenceSync(GL_SYNC_GPU_COMMANDS_COMPLETE, 0);
  glFlush();
}

bool PixelReader::answered(std::optional<PickedPixel>& answer) {
  if (!fence_) return false;
  const GLenum state = glClientWaitSync(fence_, 0, 0);
  if (state != GL_ALREADY_SIGNALED && state != GL_CONDITION_SATISFIED) return false;
  glDeleteSync(fence_);
  fence_ = nullptr;

  std::array<std::uint32_t, kPixels> ids{};
  std::array<glm::ivec4, kPixels> points{};
  const auto count = static_cast<std::size_t>(size_.x * size_.y);
  ids_.read(0, ids.data(), count * sizeof(std::uint32_t));
  points_.read(0, points.data(), count * sizeof(glm::ivec4));
  answer.reset();
  int nearest = std::numeric_limits<int>::max();
  for (std::size_t i = 0; i < count; ++i) {
    if (ids[i] == kNoPoint) continue;
    const glm::ivec2 pixel = first_ + glm::ivec2(static_cast<int>(i) % size_.x, static_cast<int>(i) / size_.x);
    const glm::ivec2 away = pixel - place_;
    const int distance = away.x * away.x + away.y * away.y;
    if (distance >= nearest) continue;
    nearest = distance;
    answer = PickedPixel{glm::ivec3(points[i]), ids[i], static_cast<std::uint32_t>(points[i].w), pixel};
  }
  return true;
}

}  // namespace stipple
