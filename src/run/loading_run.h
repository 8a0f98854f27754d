// One method drawing a cloud that is being read, with a clock.
#pragma once

#include <optional>

#include "render/method/while_loading.h"
#include "render/store/background_load.h"
#include "src/run/view_run.h"

namespace stipple {

// Times run from the moment at which reading begins, and stand still with it between frames.
class LoadingDrawing {
 public:
  // Every pass of the method has run once when this is made; with the first frame `load` begins to read. All must
  // outlive it.
  LoadingDrawing(BackgroundLoad& load, Mode mode, const MethodOptions& method, RasterizerKind raster, const Grid& grid,
                 const PointSize& point_size, const BudgetPolicy& policy, const View& view);
  // The points come from memory, in each frame as many as its budget, which is fixed.
  LoadingDrawing(PointArrivals& replayed, Mode mode, const MethodOptions& method, RasterizerKind raster,
                 const Grid& grid, const PointSize& point_size, const BudgetPolicy& policy, const View& view);

  // Waits where nothing has come that a frame could show. Converged: all points are there in their final colours, too.
  // Throws what reading throws.
  const FrameState& draw(const View& view);

  ProgressiveRenderer& renderer() { return renderer_; }
  WhileLoading& loading() { return loading_; }

  // On this clock, at the end of a frame: the first with points; that at whose beginning all points were there; the
  // first by clusters.
  struct Times {
    std::optional<double> first_points_ms;
    std::optional<double> loaded_ms;
    std::optional<double> clusters_ms;
  };
  const Times& times() const { return times_; }

 private:
  void wait();

  BackgroundLoad* load_;  // null: from memory
  WhileLoading loading_;
  ProgressiveRenderer renderer_;
  TimedDrawing drawing_;
  FrameState state_;
  Times times_;
};

}  // namespace stipple
