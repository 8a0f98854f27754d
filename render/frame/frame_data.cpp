#include "render/frame/frame_data.h"

#include <algorithm>
#include <limits>
#include <utility>

namespace stipple {
namespace {

// Copies the rows of `part`, `width` pixels each, to where they stand in rows of `of_width`.
template <class T>
void paste(const std::vector<T>& part, int width, std::vector<T>& whole, int of_width, int at) {
  for (std::size_t row = 0; row * static_cast<std::size_t>(width) < part.size(); ++row)
    std::copy_n(part.begin() + static_cast<std::ptrdiff_t>(row) * width, width,
                whole.begin() + static_cast<std::ptrdiff_t>(row) * of_width + at);
}

}  // namespace

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

FrameData side_by_side(std::vector<FrameData> frames) {
  if (frames.size() == 1) return std::move(frames.front());
  int width = 0;
  for (const FrameData& frame : frames) width += frame.size.x;
  FrameData whole = empty_frame({width, frames.front().size.y});
  int at = 0;
  for (const FrameData& frame : frames) {
    paste(frame.ids, frame.size.x, whole.ids, width, at);
    paste(frame.rgba, frame.size.x, whole.rgba, width, at);
    paste(frame.depth, frame.size.x, whole.depth, width, at);
    paste(frame.positions, frame.size.x, whole.positions, width, at);
    at += frame.size.x;
  }
  return whole;
}

}  // namespace stipple
