// The project's own method: clusters of neighbouring points are selected on the GPU by what the last frame shows.
#pragma once

#include "render/method/cluster_selector.h"
#include "render/method/method.h"

namespace stipple {

// The whole cloud lies on the GPU in small clusters along the Morton curve, each shuffled; visible points are carried
// as vertices (S19). A cluster wholly behind what is drawn cannot change the picture of a still view and is left out of
// it; the others take turns by how many pixels their points win, each drawing as many at a time as it can cover pixels
// (T16).
class Hybrid final : public Method {
 public:
  Hybrid(const PointSet& points, const ClusterSelector::Options& options)
      : cloud_(points), selector_(cloud_, options) {}

  Carry carry() const override { return Carry::vertices; }
  void forget() override { selector_.forget(); }
  void start_view(const View&) override;
  Selection select(std::uint32_t budget) override;
  void frame_drawn(const FeedbackTarget& frame) override;
  bool finished() const override { return !new_view_ && open_ == 0; }
  SelectionCounts counts() const override { return counts_; }

 private:
  ClusterCloud cloud_;
  ClusterSelector selector_;
  SelectionCounts counts_;
  View view_;
  std::uint32_t open_ = 0;  // clusters with points left for this view
  bool new_view_ = true;    // nothing was selected for this view
  bool to_learn_ = false;   // from the next frame
};

}  // namespace stipple
