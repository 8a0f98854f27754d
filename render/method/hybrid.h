// The project's own method: clusters of neighbouring points are selected on the GPU by what the last frame shows.
#pragma once

#include <memory>

#include "render/method/cluster_selector.h"
#include "render/method/cluster_source.h"
#include "render/method/method.h"

namespace stipple {

// Visible points are carried as vertices (S19), and while the view stands still they stay where they are. A cluster
// wholly behind what is drawn cannot change the picture of a still view and is left out of it; the others take turns by
// how many pixels their points win, each drawing as many at a time as it can cover pixels (T16). Clusters lie on the
// GPU, all of them or as many as there is room for.
class Hybrid final : public Method {
 public:
  Hybrid(std::unique_ptr<ClusterSource> clusters, const ClusterSelector::Options& options)
      : clusters_(std::move(clusters)), selector_(clusters_->table(), options), skips_(options.skips) {}

  Carry carry() const override { return Carry::vertices; }
  bool keeps_still_view() const override { return skips_.still; }
  bool draws_on() const override { return !skips_.converged; }
  void forget() override { selector_.forget(); }
  void start_view(const View&) override;
  bool selects_by_picture() const override { return true; }
  void see(const FeedbackTarget& frame, std::size_t eye) override { selector_.see(frame, eye); }
  void warm_up(const View& view, const FeedbackTarget& frame) override { selector_.warm_up(view, frame); }
  Selection select(std::uint32_t budget) override;
  void frame_drawn(const FeedbackTarget& frame, std::size_t eye) override;
  bool finished() const override { return selected_ && open_ == 0 && clusters_->finished(); }
  SelectionCounts counts() const override;
  std::optional<SkipCounts> skipped() const override { return selector_.skipped(); }
  Unread unread() const override { return clusters_->unread(); }
  std::optional<std::vector<ColoredPoints>> colored() const override { return clusters_->colored(); }
  // Of a tree on disk, those that are on the GPU.
  std::vector<SightedBox> boxes() const override { return selected_ ? selector_.boxes() : std::vector<SightedBox>{}; }

 private:
  std::unique_ptr<ClusterSource> clusters_;
  ClusterSelector selector_;
  Skips skips_;
  SelectionCounts counts_;
  View view_;
  std::uint32_t open_ = 0;  // clusters with points left for this view
  bool selected_ = false;   // something for this view
  bool to_learn_ = false;   // from the frame to be drawn
};

}  // namespace stipple
