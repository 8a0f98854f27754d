// S19: Schuetz, Mandlburger, Otepka, Wimmer 2019, "Progressive Real-Time Rendering of One Billion Points Without
// Hierarchical Acceleration Structures"; S18: Schuetz, Wimmer 2018, "Progressive Real-Time Rendering of Unprocessed
// Point Clouds".
#pragma once

#include <optional>

#include "render/method/index_carry.h"
#include "render/method/method.h"
#include "render/method/steered_round.h"
#include "render/store/gpu_cloud.h"

namespace stipple {

// Stretches of the slots of a shuffled cloud, one after the other, around its end to its beginning.
struct SlotRound {
  std::size_t cursor = 0;  // first slot of the next stretch
  std::size_t left = 0;    // slots not drawn yet

  // The next stretch, of at most `budget` of the cloud's first `slots` slots, all of them at some time.
  Selection next(const GpuCloud& cloud, std::size_t slots, std::uint32_t budget);
};

// The whole cloud lies shuffled on the GPU. Each frame draws what is carried and the next stretch of the buffer, around
// its end to its beginning; a view is finished when the stretches drawn for it add up to the whole buffer.
class Unstructured final : public Method {
 public:
  // Carried as vertices (S19) or indices (S18). Indices take ids below the number of points: throws Error for others.
  Unstructured(const PointSet& points, std::uint64_t seed, Carry carry,
               const std::optional<GpuSteering>& steering = {});

  Carry carry() const override { return indices_ ? Carry::indices : Carry::vertices; }
  // The next stretch begins where the last ended, also for a new view.
  void start_view(const View&) override {
    round_.left = cloud_.size();
    if (steered_) steered_->restart(cloud_.size());
  }
  void warm_up(const View&, const FeedbackTarget&) override {
    if (steered_) steered_->next(cloud_, 0);
  }
  void append_carried(const FeedbackTarget& last, std::vector<DrawItem>& items) override {
    if (indices_) indices_->append_items(last, items);
  }
  Selection select(std::uint32_t budget) override {
    return steered_ ? steered_->next(cloud_, budget) : round_.next(cloud_, cloud_.size(), budget);
  }
  SteeredRound* steered() override { return steered_ ? &*steered_ : nullptr; }
  void frame_drawn(const FeedbackTarget&, std::size_t) override {
    if (steered_) steered_->frame_drawn();
  }
  bool finished() const override { return steered_ ? steered_->finished() : round_.left == 0; }
  std::optional<std::vector<ColoredPoints>> colored() const override { return colored_points(cloud_); }

 private:
  GpuCloud cloud_;
  std::optional<IndexCarry> indices_;
  SlotRound round_;                      // of this view
  std::optional<SteeredRound> steered_;  // takes its place
};

}  // namespace stipple
