#include "render/frame/feedback_target.h"

#include <limits>
#include <vector>

namespace stipple {
namespace {

void clear_ids(const Texture2D& ids) {
  const GLuint no_point = kNoPoint;
  glClearTexImage(ids.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &no_point);
}

}  // namespace

FeedbackTarget::FeedbackTarget(const glm::ivec2& size, DepthStorage storage)
    : storage_(storage),
      points_(GL_RGBA32I, size),
      ids_(GL_R32UI, size),
      depth_(storage == DepthStorage::attachment ? GL_DEPTH_COMPONENT32F : GL_R32UI, size) {
  clear();
}

void FeedbackTarget::clear() {
  // The points need no clearing: they are read only where there is an id
  clear_ids(ids_);
  if (carried_ids_) clear_ids(*carried_ids_);
  if (storage_ == DepthStorage::attachment) {
    const GLfloat far = 0.0f;
    glClearTexImage(depth_.name(), 0, GL_DEPTH_COMPONENT, GL_FLOAT, &far);
  } else {
    const GLuint far = 0;
    glClearTexImage(depth_.name(), 0, GL_RED_INTEGER, GL_UNSIGNED_INT, &far);
  }
}

const Texture2D& FeedbackTarget::make_carried_ids() {
  if (!carried_ids_) {
    carried_ids_.emplace(GL_R32UI, size());
    clear_ids(*carried_ids_);
  }
  return *carried_ids_;
}

FrameData FeedbackTarget::read(double near) const {
  glMemoryBarrier(GL_TEXTURE_UPDATE_BARRIER_BIT);
  FrameData frame = empty_frame(size());
  const std::size_t pixels = frame.pixels();

  std::vector<glm::ivec4> points(pixels);
  read_texture(points_, GL_RGBA_INTEGER, GL_INT, sizeof(glm::ivec4), points.data());
  read_texture(ids_, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, frame.ids.data());
  if (storage_ == DepthStorage::attachment)
    read_texture(depth_, GL_DEPTH_COMPONENT, GL_FLOAT, 4, frame.depth.data());
  else
    read_texture(depth_, GL_RED_INTEGER, GL_UNSIGNED_INT, 4, frame.depth.data());

  for (std::size_t i = 0; i < pixels; ++i) {
    if (frame.ids[i] == kNoPoint) {
      frame.depth[i] = std::numeric_limits<float>::infinity();
      continue;
    }
    frame.depth[i] = static_cast<float>(near / static_cast<double>(frame.depth[i]));
    frame.positions[i] = glm::ivec3(points[i]);
    frame.rgba[i] = static_cast<std::uint32_t>(points[i].w);
  }
  return frame;
}

}  // namespace stipple
