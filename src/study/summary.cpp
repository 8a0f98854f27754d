#include "src/study/summary.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "render/measure/percentile.h"
#include "render/measure/psnr.h"
#include "src/run/median.h"

namespace stipple {
namespace {

// Over the repeats: null when any of them did not get there.
Json reached_json(std::span<const Curve> repeats, const std::function<std::optional<Reached>(const Curve&)>& reach) {
  std::vector<double> times;
  std::vector<double> points;
  for (const Curve& curve : repeats) {
    const std::optional<Reached> reached = reach(curve);
    if (!reached) return nullptr;
    times.push_back(reached->milliseconds);
    points.push_back(static_cast<double>(reached->points_drawn));
  }
  const bool timed = repeats.front().timed;
  return {{"points", static_cast<std::uint64_t>(median(points))},
          {"ms_median", timed ? Json(median(times)) : Json()},
          {"ms_min", timed ? Json(std::ranges::min(times)) : Json()},
          {"ms_max", timed ? Json(std::ranges::max(times)) : Json()},
          {"ssim", json_of(reach(repeats.front())->ssim)},
          {"flip", json_of(reach(repeats.front())->flip)}};
}

// Of the frames of all repeats.
std::vector<double> frame_times(std::span<const Curve> repeats) {
  std::vector<double> times;
  for (const Curve& curve : repeats) {
    double before = 0.0;
    for (const CurvePoint& point : curve.points) {
      times.push_back(point.state.milliseconds - before);
      before = point.state.milliseconds;
    }
  }
  return times;
}

Json frame_times_json(const std::vector<double>& times) {
  return {{"p50", percentile(times, 50.0)}, {"p95", percentile(times, 95.0)}, {"p99", percentile(times, 99.0)}};
}

// A number of each frame; nothing where it was not measured.
using Measure = std::function<std::optional<double>(const CurvePoint&)>;

// Over the frames where it was measured; nothing where it never was.
std::optional<double> mean_of(const Curve& curve, const Measure& measure) {
  double sum = 0.0;
  int count = 0;
  for (const CurvePoint& point : curve.points)
    if (const std::optional<double> value = measure(point)) {
      sum += *value;
      ++count;
    }
  return count ? std::optional(sum / count) : std::nullopt;
}

// Of one frame or, by way of `of`, of several; decibels are those of the mean error.
Json quality_json(const std::function<std::optional<double>(const Measure&)>& of) {
  using Point = const CurvePoint&;
  const double mse = *of([](Point p) { return p.mse; });
  const double covered_mse = *of([](Point p) { return p.covered_mse; });
  return {{"psnr_db", json_of_any(psnr_db(mse))},
          {"psnr_covered_db", json_of_any(psnr_db(covered_mse))},
          {"ssim", json_of(of([](Point p) { return p.ssim; }))},
          {"flip", json_of(of([](Point p) { return p.flip; }))},
          {"hole", *of([](Point p) { return p.rates.hole; })},
          {"see_through", *of([](Point p) { return p.rates.see_through; })},
          {"ghost", *of([](Point p) { return p.rates.ghost; })},
          {"wrong_point", *of([](Point p) { return p.rates.wrong_point; })},
          {"depth_error_mean", *of([](Point p) { return p.rates.depth_error_mean; })},
          {"depth_error_p95", *of([](Point p) { return p.rates.depth_error_p95; })},
          {"mse", mse},
          {"mse_rounding", *of([](Point p) { return p.parts.rounding; })},
          {"mse_selection", *of([](Point p) { return p.parts.selection; })},
          {"mse_carry", *of([](Point p) { return p.parts.carry; })},
          {"reuse", json_of(of([](Point p) { return p.reuse; }))},
          {"flicker", json_of(of([](Point p) { return p.flicker; }))}};
}

// Area under the curve of error against points: the mean of the error on the way to `points_total` points. A frame's
// error counts for the points that it drew, the last one's for what is left.
double mse_on_the_way(const Curve& curve, std::uint64_t points_total) {
  double area = 0.0;
  std::uint64_t drawn = 0;
  for (const CurvePoint& point : curve.points) {
    area += point.mse * static_cast<double>(point.state.points_drawn - drawn);
    drawn = point.state.points_drawn;
  }
  if (points_total > drawn) area += curve.points.back().mse * static_cast<double>(points_total - drawn);
  const std::uint64_t points = std::max(points_total, drawn);
  return points ? area / static_cast<double>(points) : curve.points.back().mse;
}

}  // namespace

Json summary_json(std::span<const Curve> repeats, double target_ms, std::uint64_t points_total) {
  const Curve& first = repeats.front();
  Json reached;
  for (const double quality : kQualities)
    reached[fmt::format("{:.0f}_db", quality)] =
        reached_json(repeats, [quality](const Curve& curve) { return reaches(curve, quality); });
  reached["identical"] = reached_json(repeats, reaches_identical);

  const CurvePoint& last = first.points.back();
  const std::vector<double> times = frame_times(repeats);
  const bool target = first.timed && target_ms > 0.0;
  const auto over = std::ranges::count_if(times, [target_ms](double ms) { return ms > target_ms; });
  Json json{
      {"dataset", first.dataset},
      {"regime", first.regime},
      {"view", first.view},
      {"mode", first.mode},
      {"raster", first.raster},
      {"repeats", repeats.size()},
      {"frames", last.state.frame},
      {"points_drawn", last.state.points_drawn},
      {"covered_pixels", last.state.covered_pixels},
      {"frame_ms", first.timed ? frame_times_json(times) : Json()},
      {"target_ms", target ? Json(target_ms) : Json()},
      {"frames_over_target", target ? Json(static_cast<double>(over) / static_cast<double>(times.size())) : Json()}};
  json.update(quality_json([&](const Measure& measure) { return measure(last); }));
  json["area_db"] = json_of_any(psnr_db(mse_on_the_way(first, points_total)));
  json["converged"] = last.state.converged;
  json["identical_to_brute_force"] = last.identical;
  json["reached"] = reached;
  json["loaded"] =
      reached_json(repeats, [points_total](const Curve& curve) { return reaches_all_loaded(curve, points_total); });
  json["first"] = quality_json([&](const Measure& measure) { return measure(first.points.front()); });
  json["mean"] = quality_json([&](const Measure& measure) { return mean_of(first, measure); });
  return json;
}

}  // namespace stipple
