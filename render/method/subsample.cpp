#include "render/method/subsample.h"

#include <algorithm>

namespace stipple {

Selection Subsample::select(std::uint32_t budget) {
  const std::size_t count = std::min<std::size_t>(budget, cloud_.size() - drawn_);
  first_frame_ = drawn_ == 0;
  Selection selection;
  cloud_.append_items(drawn_, count, selection.items);
  selection.points = count;
  drawn_ += count;
  return selection;
}

}  // namespace stipple
