// The frame loop that all methods share: select, reproject, fill, swap.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "octree/cloud/grid.h"
#include "render/frame/carry_once.h"
#include "render/frame/feedback_target.h"
#include "render/frame/vertex_carry.h"
#include "render/frame/view_block.h"
#include "render/method/method.h"
#include "render/raster/rasterizer.h"

namespace stipple {

// What one frame did.
struct FrameReport {
  std::uint64_t points_filled = 0;
  bool converged = false;    // the picture equals the brute-force picture of this view
  std::uint32_t budget = 0;  // points it was allowed
};

// A view of two eyes has one selection: what it streams is drawn into the frame of each (T16), and each eye carries
// its own.
class ProgressiveRenderer {
 public:
  // `method` must outlive the renderer. Throws UsageError for a point size that the rasterizer does not draw
  // (Rasterizer::point_sizes).
  ProgressiveRenderer(Method& method, RasterizerKind rasterizer, const Grid& grid, const PointSize& point_size = {});

  // Makes targets of this size for each eye and has every pass run once on a single point, so that the driver's
  // compiling and allocating stay outside of timed parts. The next frame starts from nothing. Waits for the GPU.
  void warm_up(const glm::ivec2& size, std::size_t eyes = 1);

  // Goes on with `method`, which must outlive the renderer, from the picture that is there: the next frame carries it
  // as the new method does; where that carries nothing, until it has points. The methods must draw the same points,
  // with the same ids.
  void use(Method& method);

  // Gives the points of the picture, from which the next frame carries them, these colours.
  void recolor(const ColorUpload& colors);

  // Draws the next frame: the last one, of whatever size, reprojected into `view` or, where the view is the same and
  // the method likes it, as it stands; and at most `budget` more points. A second eye begins with what the first saw. A
  // converged, still view costs nothing. Commands are issued, not awaited. Where the GPU steers (steered()), `budget`
  // is the most, and the report is as late as the GPU: it holds what that told since the last one, perhaps of no frame
  // yet.
  FrameReport draw(const View& view, std::uint32_t budget);
  // Whether frames of this method can be added to: it carries the last one over.
  bool adds_to_frames() const { return method_->carry() != Carry::none; }
  // At most `budget` more points in the frame that draw() began, of a method that adds to frames and is not steered by
  // the GPU. The report is of these.
  FrameReport draw_more(std::uint32_t budget);
  // The last frame's report, complete: waits for the GPU if that steers.
  FrameReport await_report();
  // Whether the GPU decides how many points a frame of this method draws.
  bool steered() const { return method_->steered() != nullptr; }

  // The last frame of this eye, on the GPU; null before the first, and where the last view had fewer eyes. Valid until
  // the next draw().
  const FeedbackTarget* frame(std::size_t eye = 0) const {
    if (eye >= eyes_.size()) return nullptr;
    const auto& target = eyes_[eye].targets[current_];
    return target ? &*target : nullptr;
  }

  // The last frame. Both wait for the GPU and belong outside of timed parts.
  FrameData read(std::size_t eye = 0);
  std::uint64_t covered_pixels(std::size_t eye = 0);

  // Points of the frame before the last that were drawn again in the last: one for each of its pixels where points
  // cover no more than one; else one for each point, and a few twice. 0 where the last stood or was not
  // carried. Waits for the GPU.
  std::uint64_t points_reprojected(std::size_t eye = 0);

 private:
  struct Eye {
    ViewUniforms block;
    std::array<std::optional<FeedbackTarget>, 2> targets;
  };

  void resize(const glm::ivec2& size);
  // With room for this frame.
  void make_carry(const FeedbackTarget& frame);
  // Called for a finished frame before it is carried.
  void choose_carried(FeedbackTarget& frame);
  void append_carry(Carry carry, std::vector<DrawItem>& items, std::size_t eye);
  void append_vertices(std::vector<DrawItem>& items, std::size_t eye);
  // The next targets, and each eye's block.
  void begin_frame();
  // What is carried, and no more; the eye's block is bound.
  void draw_carried(std::size_t eye);
  // The method sees the picture that it adds to; what is not carried into it yet is, unless `carried`.
  void show_picture(bool carried);
  // Has the method select, and draws that over the picture, or with what is carried; returns how many points.
  std::uint64_t draw_selected(std::uint32_t budget, bool over_picture);
  FeedbackTarget& current(std::size_t eye = 0) { return *eyes_[eye].targets[current_]; }
  FeedbackTarget& previous(std::size_t eye = 0) {
    auto& own = eyes_[eye].targets[1 - current_];
    return own ? *own : *eyes_[0].targets[1 - current_];
  }

  Method* method_;
  std::unique_ptr<Rasterizer> rasterizer_;
  Grid grid_;
  PointSize point_size_;
  std::optional<CarryOnce> once_;  // where points may cover several pixels
  CoverageCounter coverage_;
  std::vector<Eye> eyes_;                // as many as the last view had
  std::optional<VertexCarry> vertices_;  // one eye's after the other's
  int carry_room_ = 0;                   // pixels
  std::size_t current_ = 0;
  View view_;                    // of size 0: none
  FrameReport report_;           // of the last frame
  bool blank_ = true;            // no frame was drawn yet
  bool view_drawn_ = false;      // whether the last frame shows view_
  Carry carried_ = Carry::none;  // how the frame before got into the last
  bool kept_ = false;            // the last frame is the one before and what was added to it
};

}  // namespace stipple
