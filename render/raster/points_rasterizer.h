// GL_POINTS with a depth test, as the papers draw, then once more at equal depth to give ties to the lowest id.
#pragma once

#include "render/raster/rasterizer.h"
#include "render/raster/sources.h"

namespace stipple {

class PointsRasterizer final : public Rasterizer {
 public:
  // `splats`: points may be larger or smaller than a pixel.
  explicit PointsRasterizer(bool splats);
  DepthStorage depth_storage() const override { return DepthStorage::attachment; }
  // What the driver does not clamp.
  glm::dvec2 point_sizes() const override;
  // A step of the driver's raster of places.
  double snapping() const override;

 private:
  void rasterize(FeedbackTarget& target, std::span<const DrawItem> items, bool over_picture) override;

  SourcePrograms nearest_;
  SourcePrograms claim_;
  SourcePrograms repeat_;
  TieNotes notes_;
  Handle<gl_delete::vertex_array> no_attributes_;
  GpuBuffer repeat_command_;
};

}  // namespace stipple
