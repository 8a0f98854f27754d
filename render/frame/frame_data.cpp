#include "render/frame/frame_data.h"

#include <algorithm>
#include <limits>

namespace stipple {

std::size_t FrameData::covered_pixels() const {
  return ids.size() - static_cast<std::size_t>(std::ranges::count(ids, kNoPoint));
}

FrameData empty_frame(const glm::ivec2& size) {
  FrameData frame;
  frame.size = size;
  frame.ids.assign(frame.pixels(), kNoPoint);
  frame.rgba.assign(frame.pixels(), 0);
  frame.depth.assign(frame.pixels(), std::numeric_limits<float>::infinity());
  frame.positions.assign(frame.pixels(), glm::ivec3(0));
  return frame;
}

}  // namespace stipple
