// What desktop viewers do: the baseline that T16 compares with (section 4).
#pragma once

#include "render/method/method.h"
#include "render/store/gpu_cloud.h"

namespace stipple {

// The whole cloud lies shuffled on the GPU. A frame of a new view draws the first points of the buffer and nothing
// else, so that while the camera moves the picture is a sparse, even subset; when it stands still, frames add what
// follows.
class Subsample final : public Method {
 public:
  Subsample(const PointSet& points, std::uint64_t seed) : cloud_(upload_shuffled(points, seed)) {}

  Carry carry() const override { return drawn_ == 0 || first_frame_ ? Carry::none : Carry::grid; }
  void start_view(const View&) override { drawn_ = 0; }
  Selection select(std::uint32_t budget) override;
  bool finished() const override { return drawn_ == cloud_.size(); }
  std::optional<std::vector<ColoredPoints>> colored() const override { return colored_points(cloud_); }

 private:
  GpuCloud cloud_;
  std::size_t drawn_ = 0;     // slots, for this view
  bool first_frame_ = false;  // of a view, is the one that was selected last
};

}  // namespace stipple
