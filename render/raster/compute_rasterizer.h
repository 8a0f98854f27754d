// Points by compute shaders and atomics: a depth pass, then a pass that settles who owns the pixel.
#pragma once

#include "render/raster/rasterizer.h"
#include "render/raster/sources.h"

namespace stipple {

class ComputeRasterizer final : public Rasterizer {
 public:
  // `splats`: points may be larger than a pixel.
  explicit ComputeRasterizer(bool splats);
  DepthStorage depth_storage() const override { return DepthStorage::image; }
  // Mesa's software renderer leaves a loop after 65,535 steps: 255 x 255 pixels.
  glm::dvec2 point_sizes() const override { return {0.0, 255.0}; }

 private:
  void rasterize(FeedbackTarget& target, std::span<const DrawItem> items, bool over_picture) override;

  SourcePrograms depth_;
  SourcePrograms depth_over_picture_;
  SourcePrograms claim_;
  SourcePrograms repeat_;
  TieNotes notes_;
};

}  // namespace stipple
