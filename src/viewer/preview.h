// What has been read of a cloud, while the rest is being read.
#pragma once

#include "render/method/method.h"
#include "render/store/gpu_cloud.h"
#include "src/viewer/watched_source.h"

namespace stipple {

// Draws the points in the order in which they came; visible ones are carried as vertices.
class Preview final : public Method {
 public:
  Preview() : cloud_(kMost) {}

  // Points beyond kMost are left out.
  void add(const PreviewPoints& points);
  std::size_t size() const { return size_; }

  Carry carry() const override { return Carry::vertices; }
  void start_view(const View&) override { drawn_ = 0; }
  Selection select(std::uint32_t budget) override;
  bool finished() const override { return drawn_ == size_; }
  std::optional<std::vector<ColoredPoints>> colored() const override { return colored_points(cloud_); }

 private:
  // Several files begin to count anew each
  static constexpr std::size_t kMost = 2 * WatchedSource::kPreviewPoints;
  static_assert(kMost <= GpuCloud::kChunkPoints);

  GpuCloud cloud_;
  std::size_t size_ = 0;
  std::size_t drawn_ = 0;  // for this view
};

}  // namespace stipple
