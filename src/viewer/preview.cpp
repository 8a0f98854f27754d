#include "src/viewer/preview.h"

#include <algorithm>

namespace stipple {

void Preview::add(const PreviewPoints& points) {
  const std::size_t count = std::min(points.points.size(), kMost - size_);
  GpuCloud::Chunk& chunk = cloud_.chunks().front();
  chunk.points.write(size_ * sizeof(PackedPoint), std::span(points.points).first(count));
  chunk.ids.write(size_ * sizeof(std::uint32_t), std::span(points.ids).first(count));
  size_ += count;
}

Selection Preview::select(std::uint32_t budget) {
  Selection selection;
  selection.points = std::min<std::size_t>(budget, size_ - drawn_);
  if (selection.points > 0) cloud_.append_items(drawn_, selection.points, selection.items);
  drawn_ += selection.points;
  return selection;
}

}  // namespace stipple
