// The frame loop that all methods share: select, reproject, fill, swap.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "octree/cloud/grid.h"
#include "render/frame/feedback_target.h"
#include "render/frame/vertex_carry.h"
#include "render/frame/view_block.h"
#include "render/method/method.h"
#include "render/raster/rasterizer.h"

namespace stipple {

// What one frame did.
struct FrameReport {
  std::uint64_t points_filled = 0;
  bool converged = false;  // the picture equals the brute-force picture of this view
};

class ProgressiveRenderer {
 public:
  // `method` must outlive the renderer. `point_size` in pixels, above 0. Throws UsageError for a size that the
  // rasterizer does not draw (Rasterizer::point_sizes).
  ProgressiveRenderer(Method& method, RasterizerKind rasterizer, const Grid& grid, double point_size = 1.0);

  // Makes targets of this size and has every pass run once on a single point, so that the driver's compiling and
  // allocating stay outside of timed parts. The next frame starts from nothing. Waits for the GPU.
  void warm_up(const glm::ivec2& size);

  // Goes on with `method`, which must outlive the renderer, from the picture that is there: the next frame carries it
  // as the new method does. The methods must draw the same points, with the same ids.
  void use(Method& method);

  // Draws the next frame: the last one, of whatever size, reprojected into `view` or, where the view is the same and
  // the method likes it, as it stands; and at most `budget` more points. A converged, still view costs nothing.
  // Commands are issued, not awaited.
  FrameReport draw(const View& view, std::uint32_t budget);

  // The last frame, on the GPU; null before the first. Valid until the next draw().
  const FeedbackTarget* frame() const { return targets_[current_] ? &*targets_[current_] : nullptr; }

  // The last frame. Both wait for the GPU and belong outside of timed parts.
  FrameData read();
  std::uint64_t covered_pixels();

  // Pixels of the frame before the last, each drawn again as a point in the last: 0 where the last stood, and for
  // methods that carry nothing. Waits for the GPU.
  std::uint64_t points_reprojected();

 private:
  void resize(const glm::ivec2& size);
  void make_carry();
  void append_carry(std::vector<DrawItem>& items);
  FeedbackTarget& current() { return *targets_[current_]; }
  FeedbackTarget& previous() { return *targets_[1 - current_]; }

  Method* method_;
  std::unique_ptr<Rasterizer> rasterizer_;
  Grid grid_;
  double point_size_;
  ViewUniforms uniforms_;
  CoverageCounter coverage_;
  std::array<std::optional<FeedbackTarget>, 2> targets_;
  std::optional<VertexCarry> vertices_;
  int carry_room_ = 0;  // pixels
  std::size_t current_ = 0;
  View view_;                // of size 0: none
  bool blank_ = true;        // no frame was drawn yet
  bool view_drawn_ = false;  // whether the last frame shows view_
  bool kept_ = false;        // the last frame is the one before and what was added to it
};

}  // namespace stipple
