// Everything, every frame.
#pragma once

#include "render/method/method.h"
#include "render/store/gpu_cloud.h"

namespace stipple {

class BruteForce final : public Method {
 public:
  explicit BruteForce(const PointSet& points) : cloud_(upload_in_order(points)) {}

  Carry carry() const override { return Carry::none; }
  void start_view(const View&) override { drawn_ = false; }
  // All points, whatever the budget.
  Selection select(std::uint32_t) override {
    Selection selection;
    cloud_.append_items(0, cloud_.size(), selection.items);
    selection.points = cloud_.size();
    drawn_ = true;
    return selection;
  }
  bool finished() const override { return drawn_; }
  std::optional<std::vector<ColoredPoints>> colored() const override { return colored_points(cloud_); }

 private:
  GpuCloud cloud_;
  bool drawn_ = false;
};

}  // namespace stipple
