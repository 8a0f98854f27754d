#include "render/method/hybrid.h"

namespace stipple {

void Hybrid::start_view(const View& view) {
  view_ = view;
  new_view_ = true;
}

Selection Hybrid::select(std::uint32_t budget) {
  Selection selection;
  if (budget == 0) return selection;
  const ClusterSelector::Result result = selector_.select(view_, budget, new_view_);
  new_view_ = false;
  open_ = result.open;
  counts_.nodes_visible = result.visible;
  counts_.nodes_occluded = result.occluded;
  selection.points = result.points;
  for (std::size_t c = 0; c < result.chunks.size(); ++c) {
    const ClusterSelector::Taken& taken = result.chunks[c];
    const ClusterCloud::Chunk& chunk = cloud_.chunks()[c];
    if (taken.points > 0)
      selection.items.push_back(
          PickedPoints{&chunk.points, &chunk.ids, &selector_.places(), taken.first_place, taken.points});
  }
  to_learn_ = open_ > 0;
  return selection;
}

void Hybrid::frame_drawn(const FeedbackTarget& frame) {
  if (to_learn_) selector_.learn(frame);
  to_learn_ = false;
}

}  // namespace stipple
