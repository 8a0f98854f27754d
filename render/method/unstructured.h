// S19: Schuetz, Mandlburger, Otepka, Wimmer 2019, "Progressive Real-Time Rendering of One Billion Points Without
// Hierarchical Acceleration Structures"; S18: Schuetz, Wimmer 2018, "Progressive Real-Time Rendering of Unprocessed
// Point Clouds".
#pragma once

#include <optional>

#include "render/method/index_carry.h"
#include "render/method/method.h"
#include "render/method/slot_round.h"
#include "render/store/gpu_cloud.h"

namespace stipple {

// The whole cloud lies shuffled on the GPU. Each frame draws what is carried and the next stretch of the buffer, around
// its end to its beginning; a view is finished when the stretches drawn for it add up to the whole buffer.
class Unstructured final : public Method {
 public:
  // Carried as vertices (S19) or indices (S18). Indices take ids below the number of points: throws Error for others.
  Unstructured(const PointSet& points, std::uint64_t seed, Carry carry,
               const std::optional<GpuSteering>& steering = {});

  Carry carry() const override { return indices_ ? Carry::indices : Carry::vertices; }
  // The next stretch begins where the last ended, also for a new view.
  void start_view(const View&) override { round_.restart(cloud_.size()); }
  void append_carried(const FeedbackTarget& last, std::vector<DrawItem>& items) override {
    if (indices_) indices_->append_items(last, items);
  }
  SteeredRound* steered() override { return round_.steered(); }
  Selection select(std::uint32_t budget) override { return round_.next(cloud_, budget); }
  bool finished() const override { return round_.finished(); }
  std::optional<std::vector<ColoredPoints>> colored() const override { return colored_points(cloud_); }

 private:
  GpuCloud cloud_;
  std::optional<IndexCarry> indices_;
  SlotRound round_;  // of this view
};

}  // namespace stipple
