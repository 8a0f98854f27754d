#include "render/method/hybrid.h"

namespace stipple {

void Hybrid::start_view(const View& view) {
  view_ = view;
  selected_ = false;
  selector_.start_view(view);
  clusters_->start_view(view);
}

Selection Hybrid::select(std::uint32_t budget) {
  Selection selection;
  to_learn_ = false;
  if (budget == 0) return selection;
  clusters_->load(budget, selector_);
  const ClusterSelector::Result result = selector_.select(view_, budget);
  selected_ = true;
  open_ = result.open;
  counts_.nodes_visible = result.visible;
  counts_.nodes_occluded = result.occluded;
  selection.points = result.points;
  for (std::size_t c = 0; c < result.chunks.size(); ++c) {
    const ClusterSelector::Taken& taken = result.chunks[c];
    const ClusterTable::Chunk& chunk = clusters_->table().chunks[c];
    if (taken.points > 0)
      selection.items.push_back(
          PickedPoints{&chunk.points, &chunk.ids, &selector_.places(), taken.first_place, taken.points});
  }
  to_learn_ = open_ > 0 || !clusters_->finished();
  return selection;
}

void Hybrid::frame_drawn(const FeedbackTarget& frame, std::size_t) {
  if (to_learn_) selector_.learn_yield(frame);
}

SelectionCounts Hybrid::counts() const {
  SelectionCounts counts = counts_;
  clusters_->count(counts);
  return counts;
}

}  // namespace stipple
