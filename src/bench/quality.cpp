#include <fmt/format.h>

#include <algorithm>

#include "render/frame/propose_views.h"
#include "render/measure/psnr.h"
#include "src/bench/parts.h"
#include "src/study/curve.h"
#include "src/study/truth.h"

namespace stipple {
namespace {

// Frames until the picture is that of brute force, or nothing is left to draw. Measuring is outside the clock.
Curve curve_of_run(Mode mode, const Dataset& dataset, const BenchSettings& settings, const View& view,
                   const Truth& truth) {
  const auto method = make_method(mode, dataset, {.largest_budget = settings.budget});
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid);
  Curve curve;
  run_view(renderer, view, {.points = settings.budget, .frames_per_second = {}}, {}, [&](const FrameState& state) {
    const FrameData frame = renderer.read();
    CurvePoint& point = curve.points.emplace_back();
    point.state = state;
    point.mse = mean_squared_error(compose(frame, TruthMaker::Options{}.background), truth.reference);
    point.identical = frame.ids == truth.brute_force_ids;
  });
  return curve;
}

// Nothing where a run did not get there.
template <class Reach>
std::optional<Timing> timing_of(const std::vector<Curve>& runs, std::string part, const Reach& reach) {
  Timing timing{std::move(part), "points drawn", 0.0, {}, Json::object(), ""};
  for (const Curve& run : runs) {
    const std::optional<Reached> reached = reach(run);
    if (!reached) return std::nullopt;
    timing.amount = static_cast<double>(reached->points_drawn);
    timing.milliseconds.push_back(reached->milliseconds);
  }
  return timing;
}

}  // namespace

void bench_quality(const Dataset& dataset, const BenchSettings& settings,
                   const std::function<void(const QualityRow&)>& show) {
  const auto cameras = propose_cameras(dataset.points, static_cast<double>(settings.size.x) / settings.size.y);
  const View view = make_view(cameras.front().camera, settings.size, near_plane(dataset.points.grid));
  const Truth truth = TruthMaker(dataset, {}).make(view);
  for (const Mode mode : all_modes()) {
    std::vector<Curve> runs;
    for (int run = 0; run < std::min(settings.repeats, 3); ++run)
      runs.push_back(curve_of_run(mode, dataset, settings, view, truth));
    QualityRow row{mode, {}};
    for (const double db : kQualities)
      row.reached.push_back(timing_of(runs, fmt::format("{} to {:.0f} dB", name_of(mode), db),
                                      [db](const Curve& curve) { return reaches(curve, db); }));
    row.reached.push_back(timing_of(runs, fmt::format("{} to identical", name_of(mode)), reaches_identical));
    show(row);
  }
}

}  // namespace stipple
