// Points by compute shaders and atomics: a depth pass, then a pass that settles who owns the pixel.
#pragma once

#include <optional>

#include "render/raster/pixel_keys.h"
#include "render/raster/rasterizer.h"
#include "render/raster/sources.h"
#include "render/raster/vertex_list.h"

namespace stipple {

class ComputeRasterizer final : public Rasterizer {
 public:
  static constexpr std::size_t kBatch = std::size_t{1} << 21;
  // `splats`: points may be larger or smaller than a pixel. `keys`: with 64-bit atomics, which the driver must have.
  // `batch`: so many points, of those whose number the CPU knows, are drawn at a time.
  explicit ComputeRasterizer(bool splats, bool keys = has_64_bit_atomics(), std::size_t batch = kBatch);
  DepthStorage depth_storage() const override { return DepthStorage::image; }
  // Mesa's software renderer leaves a loop after 65,535 steps: 255 x 255 pixels.
  glm::dvec2 point_sizes() const override { return {0.0, 255.0}; }

 private:
  void rasterize(FeedbackTarget& target, std::span<const DrawItem> items, bool over_picture) override;

  // Points that the CPU has counted.
  void draw_batch(std::span<const DrawItem> items, bool over_picture);
  void settle_ties(std::span<const DrawItem> items);

  std::size_t batch_;
  std::optional<PixelKeys> keys_;         // either these
  std::optional<TieNotes> notes_;         // or these
  std::optional<VertexList> contenders_;  // the points of a batch that may own a pixel
  SourcePrograms depth_;
  SourcePrograms depth_over_picture_;
  SourcePrograms collect_;
  SourcePrograms collect_over_picture_;
  SourcePrograms claim_;
  SourcePrograms repeat_;
};

}  // namespace stipple
