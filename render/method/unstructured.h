// S19: Schuetz, Mandlburger, Otepka, Wimmer 2019, "Progressive Real-Time Rendering of One Billion Points Without
// Hierarchical Acceleration Structures"; S18: Schuetz, Wimmer 2018, "Progressive Real-Time Rendering of Unprocessed
// Point Clouds".
#pragma once

#include <optional>

#include "render/method/index_carry.h"
#include "render/method/method.h"
#include "render/store/gpu_cloud.h"

namespace stipple {

// The whole cloud lies shuffled on the GPU. Each frame draws what is carried and the next stretch of the buffer, around
// its end to its beginning; a view is finished when the stretches drawn for it add up to the whole buffer.
class Unstructured final : public Method {
 public:
  // Carried as vertices (S19) or indices (S18). Indices take ids below the number of points: throws Error for others.
  Unstructured(const PointSet& points, std::uint64_t seed, Carry carry);

  Carry carry() const override { return indices_ ? Carry::indices : Carry::vertices; }
  void forget() override {
    if (indices_) indices_->forget();
  }
  // The next stretch begins where the last ended, also for a new view.
  void start_view(const View&) override { left_ = cloud_.size(); }
  std::vector<DrawItem> warm_up(const View&, const FeedbackTarget&) override;
  Selection select(std::uint32_t budget) override;
  void frame_drawn(const FeedbackTarget& frame) override {
    if (indices_) indices_->prepare(frame);
  }
  bool finished() const override { return left_ == 0; }

 private:
  GpuCloud cloud_;
  std::optional<IndexCarry> indices_;
  std::size_t cursor_ = 0;  // first slot of the next stretch
  std::size_t left_;        // slots not drawn yet for this view
};

}  // namespace stipple
