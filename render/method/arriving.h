// Mode unstructured while its points arrive: S19, section 4.1, and S18 (see unstructured.h).
#pragma once

#include <optional>

#include "render/method/index_carry.h"
#include "render/method/method.h"
#include "render/method/slot_round.h"
#include "render/store/growing_cloud.h"

namespace stipple {

// Each frame draws what is carried and the next stretch of the slots that there are, around their end to their
// beginning. Points that arrive may be in slots that were drawn: from then on all slots are still to be drawn. A view
// is finished when all points are there and all slots were drawn since the last of them came.
class Arriving final : public Method {
 public:
  // Of `total` points; none is there yet. Indices are carried of displaced points alone.
  Arriving(std::size_t total, ArrivalOrder order, std::uint64_t seed, Carry carry,
           const std::optional<GpuSteering>& steering = {});

  // As GrowingCloud::add().
  void add(std::span<const PackedPoint> points, std::uint32_t first_id);

  std::size_t points() const { return cloud_.points(); }
  std::uint64_t bytes_uploaded() const { return cloud_.bytes_uploaded(); }
  // Another frame of the same view would be the same.
  bool idle() const { return round_.finished(); }

  Carry carry() const override { return indices_ ? Carry::indices : Carry::vertices; }
  void start_view(const View&) override { round_.restart(cloud_.slots()); }
  // The slots of what the frame shows are looked up now: since it was drawn, points may have been displaced.
  void append_carried(const FeedbackTarget& last, std::vector<DrawItem>& items) override {
    if (indices_) indices_->append_items(last, items);
  }
  SteeredRound* steered() override { return round_.steered(); }
  Selection select(std::uint32_t budget) override { return round_.next(cloud_.cloud(), budget); }
  bool finished() const override { return idle() && cloud_.complete(); }
  std::optional<std::vector<ColoredPoints>> colored() const override { return colored_points(cloud_.cloud()); }

 private:
  GrowingCloud cloud_;
  std::optional<IndexCarry> indices_;
  SlotRound round_;  // of this view, since the last points came
};

}  // namespace stipple
