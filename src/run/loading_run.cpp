#include "src/run/loading_run.h"

#include "octree/core/stopwatch.h"

namespace stipple {

LoadingDrawing::LoadingDrawing(BackgroundLoad& load, Mode mode, const MethodOptions& method, RasterizerKind raster,
                               const Grid& grid, const PointSize& point_size, const BudgetPolicy& policy,
                               const View& view)
    : load_(&load),
      loading_(load, mode, {.method = method}),
      renderer_(loading_.method(), raster, grid, point_size),
      drawing_(renderer_, policy, view.size, view.eyes()) {}

LoadingDrawing::LoadingDrawing(PointArrivals& replayed, Mode mode, const MethodOptions& method, RasterizerKind raster,
                               const Grid& grid, const PointSize& point_size, const BudgetPolicy& policy,
                               const View& view)
    : load_(nullptr),
      loading_(replayed, mode, {.method = method, .most_arrivals = policy.points, .cut_at_once = true}),
      renderer_(loading_.method(), raster, grid, point_size),
      drawing_(renderer_, policy, view.size, view.eyes()) {}

void LoadingDrawing::wait() {
  if (state_.frame == 0)
    load_->start();
  else
    load_->resume();
  if (loading_.points_loaded() > 0 && !loading_.idle()) return;
  const Stopwatch watch;
  load_->wait();
  drawing_.pass(watch.milliseconds());
}

const FrameState& LoadingDrawing::draw(const View& view) {
  if (load_) wait();
  state_ = drawing_.draw(view, [this] { loading_.advance(renderer_); });
  if (load_) load_->pause();
  const double now = state_.milliseconds;
  state_.points_loaded = loading_.points_loaded();
  if (!loading_.whole()) state_.converged = false;
  if (!times_.first_points_ms && state_.points_drawn > 0) times_.first_points_ms = now;
  if (!times_.loaded_ms && loading_.whole()) times_.loaded_ms = now;
  if (!times_.clusters_ms && loading_.by_clusters()) times_.clusters_ms = now;
  return state_;
}

}  // namespace stipple
