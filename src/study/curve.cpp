#include "src/study/curve.h"

#include <fmt/format.h>

#include <algorithm>

#include "render/measure/psnr.h"

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

// The work of a frame alone, where the state has sums.
struct FrameWork {
  std::uint64_t streamed;     // S of Tredinnick and others 2016
  std::uint64_t reprojected;  // R
};

std::string csv_line(const Curve& curve, const CurvePoint& point, const FrameWork& work) {
  const FrameState& state = point.state;
  const FrameRates& rates = point.rates;
  return fmt::format(
      "{},{},{},{},{},{},{},{},{},{},{},1,{},{},{},{:.9g},{:.6f},{:.6f},{},{},{:.6f},{:.6f},{:.6f},{:.6f},{:.6g},"
      "{:.6g},{:.9g},{:.9g},{:.9g},{},{},{},{},{}\n",
      csv_field(curve.dataset), curve.regime, csv_field(curve.view), curve.mode, curve.raster, curve.repeat,
      state.frame, state.budget, state.points_drawn, state.points_reprojected,
      curve.timed ? fmt::format("{:.3f}", state.milliseconds) : "", work.reprojected, work.streamed,
      state.covered_pixels, point.mse, psnr_db(point.mse), psnr_db(point.covered_mse), csv_field(point.ssim),
      csv_field(point.flip), rates.hole, rates.see_through, rates.ghost, rates.wrong_point, rates.depth_error_mean,
      rates.depth_error_p95, point.parts.rounding, point.parts.selection, point.parts.carry, csv_field(point.reuse),
      csv_field(point.flicker), state.points_loaded ? std::to_string(*state.points_loaded) : "",
      point.identical ? 1 : 0, state.converged ? 1 : 0);
}

}  // namespace

std::optional<Reached> reaches(const Curve& curve, double db) {
  return first_that(curve, [db](const CurvePoint& point) { return psnr_db(point.mse) >= db; });
}

std::optional<Reached> reaches_identical(const Curve& curve) {
  return first_that(curve, [](const CurvePoint& point) { return point.identical; });
}

std::optional<Reached> reaches_all_loaded(const Curve& curve, std::uint64_t points_total) {
  return first_that(curve,
                    [points_total](const CurvePoint& point) { return point.state.points_loaded == points_total; });
}

bool QualityMarks::passes(double db) {
  const auto reached = static_cast<int>(std::ranges::count_if(kQualities, [db](double mark) { return db >= mark; }));
  if (reached <= reached_) return false;
  reached_ = reached;
  return true;
}

std::string curves_csv(std::span<const Curve> curves) {
  std::string csv =
      "dataset,regime,view,mode,raster,repeat,frame,budget,points_drawn,points_reprojected,ms,V,R,S,covered_pixels,mse,"
      "psnr_db,psnr_covered_db,ssim,flip,hole,see_through,ghost,wrong_point,depth_error_mean,depth_error_p95,"
      "mse_rounding,mse_selection,mse_carry,reuse,flicker,points_loaded,identical,converged\n";
  for (const Curve& curve : curves) {
    FrameState before;
    for (const CurvePoint& point : curve.points) {
      csv += csv_line(
          curve, point,
          {point.state.points_drawn - before.points_drawn, point.state.points_reprojected - before.points_reprojected});
      before = point.state;
    }
  }
  return csv;
}

}  // namespace stipple
