#include "src/study/curve_drawing.h"

#include "render/measure/flip.h"

namespace stipple {

CurveDrawing::CurveDrawing(const StudySettings& settings, const Dataset& dataset, Mode mode,
                           const StudyProgress& progress)
    : settings_(settings),
      progress_(progress),
      method_(make_method(mode, dataset, settings.method)),
      renderer_(*method_, settings.raster, dataset.points.grid, settings.point_size),
      drawing_(renderer_, settings.budget, settings.size),
      grid_(dataset.points.grid) {}

void CurveDrawing::observe(const FrameState& state, const View& view, const Truth& truth) {
  progress_.check();
  const FrameData frame = renderer_.read();
  image_ = compose(frame, settings_.background);
  points_.push_back(judge_->judge(state, frame, image_, view, truth));
  if (keeper_) keeper_->offer(state, image_);
}

// A frame before the part that is measured.
void CurveDrawing::pass() {
  progress_.check();
  judge_->pass(renderer_.read());
}

std::vector<CurvePoint> CurveDrawing::run(Regime regime, const Route& route, std::span<const Truth> truths,
                                          FrameKeeper* keeper) {
  keeper_ = keeper;
  judge_.emplace(grid_, FrameJudge::Options{.point_size = settings_.point_size,
                                            .flip_every_frame = settings_.flip_every_frame || regime == Regime::path,
                                            .carries = method_->carry() != Carry::none});
  Until until;
  if (settings_.clock == StudyClock::wall) until.milliseconds = 1e3 * settings_.seconds;

  // Come to where it begins
  if (regime == Regime::jump) draw_until(drawing_, *route.jumps_from, until, [this](const FrameState&) { pass(); });
  if (regime == Regime::stop)
    for (const View& view : route.views) {
      drawing_.draw(view);
      pass();
    }
  drawing_.start_again();

  if (regime == Regime::path) {
    for (std::size_t i = 0; i < route.views.size(); ++i)
      observe(drawing_.draw(route.views[i]), route.views[i], truths[i]);
  } else {
    const View& view = route.views.back();
    draw_until(drawing_, view, until, [&](const FrameState& state) { observe(state, view, truths.back()); });
  }
  CurvePoint& last = points_.back();
  if (!last.flip) last.flip = flip(image_, truths.back().reference);
  if (keeper) keeper->keep(last.state, image_);
  return std::move(points_);
}

}  // namespace stipple
