#include "src/study/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <functional>

#include "render/measure/percentile.h"
#include "render/measure/psnr.h"
#include "src/run/median.h"

namespace stipple {
namespace {

template <class Condition>
std::optional<Reached> first_that(const Curve& curve, const Condition& condition) {
  const auto found = std::ranges::find_if(curve.points, condition);
  if (found == curve.points.end()) return std::nullopt;
  return Reached{found->state.points_drawn, found->state.milliseconds, found->ssim, found->flip};
}

// A field of a CSV file: quoted where it must be (RFC 4180).
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string csv_field(const std::optional<double>& value) {
  return value ? fmt::format("{:.6f}", *value) : "";
}

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

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
  return {{"points", static_cast<std::uint64_t>(median(points))},
          {"ms_median", median(times)},
          {"ms_min", std::ranges::min(times)},
          {"ms_max", std::ranges::max(times)},
          {"ssim", json_of(reach(repeats.front())->ssim)},
          {"flip", json_of(reach(repeats.front())->flip)}};
}

// Percentiles over the frames of all repeats.
Json frame_times_json(std::span<const Curve> repeats) {
  std::vector<double> times;
  for (const Curve& curve : repeats) {
    double before = 0.0;
    for (const CurvePoint& point : curve.points) {
      times.push_back(point.state.milliseconds - before);
      before = point.state.milliseconds;
    }
  }
  return {{"p50", percentile(times, 50.0)}, {"p95", percentile(times, 95.0)}, {"p99", percentile(times, 99.0)}};
}

std::string csv_line(const Curve& curve, const CurvePoint& point) {
  const FrameState& state = point.state;
  const FrameRates& rates = point.rates;
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{:.3f},{},{:.9g},{:.6f},{:.6f},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6g},"
      "{:.6g},{},{}\n",
      csv_field(curve.dataset), csv_field(curve.view), curve.mode, curve.raster, curve.repeat, state.frame,
      state.budget, state.points_drawn, state.points_reprojected, state.milliseconds, state.covered_pixels, point.mse,
      psnr_db(point.mse), psnr_db(point.covered_mse), csv_field(point.ssim), csv_field(point.flip), rates.hole,
      rates.see_through, rates.ghost, rates.wrong_point, rates.depth_error_mean, rates.depth_error_p95,
      point.identical ? 1 : 0, state.converged ? 1 : 0);
}

}  // namespace

std::optional<Reached> reaches(const Curve& curve, double db) {
  return first_that(curve, [db](const CurvePoint& point) { return psnr_db(point.mse) >= db; });
}

std::optional<Reached> reaches_identical(const Curve& curve) {
  return first_that(curve, [](const CurvePoint& point) { return point.identical; });
}

bool QualityMarks::passes(double db) {
  const auto reached = static_cast<int>(std::ranges::count_if(kQualities, [db](double mark) { return db >= mark; }));
  if (reached <= reached_) return false;
  reached_ = reached;
  return true;
}

std::string curves_csv(std::span<const Curve> curves) {
  std::string csv =
      "dataset,view,mode,raster,repeat,frame,budget,points_drawn,points_reprojected,ms,covered_pixels,mse,psnr_db,"
      "psnr_covered_db,ssim,flip,hole,see_through,ghost,wrong_point,depth_error_mean,depth_error_p95,identical,"
      "converged\n";
  for (const Curve& curve : curves)
    for (const CurvePoint& point : curve.points) csv += csv_line(curve, point);
  return csv;
}

Json summary_json(std::span<const Curve> repeats) {
  const Curve& first = repeats.front();
  Json reached;
  for (const double quality : kQualities)
    reached[fmt::format("{:.0f}_db", quality)] =
        reached_json(repeats, [quality](const Curve& curve) { return reaches(curve, quality); });
  reached["identical"] = reached_json(repeats, reaches_identical);
  const CurvePoint& last = first.points.back();
  return {{"dataset", first.dataset},
          {"view", first.view},
          {"mode", first.mode},
          {"raster", first.raster},
          {"repeats", repeats.size()},
          {"frames", last.state.frame},
          {"points_drawn", last.state.points_drawn},
          {"covered_pixels", last.state.covered_pixels},
          {"frame_ms", frame_times_json(repeats)},
          {"psnr_db", json_of_any(psnr_db(last.mse))},
          {"psnr_covered_db", json_of_any(psnr_db(last.covered_mse))},
          {"ssim", json_of(last.ssim)},
          {"flip", json_of(last.flip)},
          {"hole", last.rates.hole},
          {"see_through", last.rates.see_through},
          {"ghost", last.rates.ghost},
          {"wrong_point", last.rates.wrong_point},
          {"depth_error_mean", last.rates.depth_error_mean},
          {"depth_error_p95", last.rates.depth_error_p95},
          {"converged", last.state.converged},
          {"identical_to_brute_force", last.identical},
          {"reached", reached}};
}

}  // namespace stipple
