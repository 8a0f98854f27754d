#include "src/study/curve_json.h"

namespace stipple {
namespace {

std::optional<double> optional_of(const Json& json) {
  return json.is_null() ? std::nullopt : std::optional(json.get<double>());
}

Json point_json(const CurvePoint& point) {
  const FrameState& state = point.state;
  const FrameRates& rates = point.rates;
  return {{"frame", state.frame},
          {"ms", state.milliseconds},
          {"points_drawn", state.points_drawn},
          {"points_reprojected", state.points_reprojected},
          {"covered_pixels", state.covered_pixels},
          {"budget", state.budget},
          {"converged", state.converged},
          {"points_loaded", state.points_loaded ? Json(*state.points_loaded) : Json()},
          {"mse", point.mse},
          {"covered_mse", point.covered_mse},
          {"ssim", json_of(point.ssim)},
          {"flip", json_of(point.flip)},
          {"covered_by_either", rates.covered_pixels},
          {"hole", rates.hole},
          {"ghost", rates.ghost},
          {"see_through", rates.see_through},
          {"wrong_point", rates.wrong_point},
          {"depth_error_mean", rates.depth_error_mean},
          {"depth_error_p95", rates.depth_error_p95},
          {"identical", point.identical},
          {"mse_rounding", point.parts.rounding},
          {"mse_selection", point.parts.selection},
          {"mse_carry", point.parts.carry},
          {"reuse", json_of(point.reuse)},
          {"flicker", json_of(point.flicker)}};
}

CurvePoint point_of(const Json& json) {
  CurvePoint point;
  point.state = {.frame = json.at("frame"),
                 .milliseconds = json.at("ms"),
                 .points_drawn = json.at("points_drawn"),
                 .points_reprojected = json.at("points_reprojected"),
                 .covered_pixels = json.at("covered_pixels"),
                 .budget = json.at("budget"),
                 .converged = json.at("converged")};
  if (const Json& loaded = json.at("points_loaded"); !loaded.is_null())
    point.state.points_loaded = loaded.get<std::uint64_t>();
  point.mse = json.at("mse");
  point.covered_mse = json.at("covered_mse");
  point.ssim = optional_of(json.at("ssim"));
  point.flip = optional_of(json.at("flip"));
  point.rates = {.covered_pixels = json.at("covered_by_either"),
                 .hole = json.at("hole"),
                 .ghost = json.at("ghost"),
                 .see_through = json.at("see_through"),
                 .wrong_point = json.at("wrong_point"),
                 .depth_error_mean = json.at("depth_error_mean"),
                 .depth_error_p95 = json.at("depth_error_p95")};
  point.identical = json.at("identical");
  point.parts = {
      .rounding = json.at("mse_rounding"), .selection = json.at("mse_selection"), .carry = json.at("mse_carry")};
  point.reuse = optional_of(json.at("reuse"));
  point.flicker = optional_of(json.at("flicker"));
  return point;
}

}  // namespace

Json json_of(const Curve& curve) {
  Json points = Json::array();
  for (const CurvePoint& point : curve.points) points.push_back(point_json(point));
  Json kept = Json::array();
  for (const KeptFrame& frame : curve.kept) kept.push_back({{"frame", frame.frame}, {"file", frame.file}});
  return {{"dataset", curve.dataset}, {"regime", curve.regime}, {"view", curve.view},
          {"mode", curve.mode},       {"raster", curve.raster}, {"repeat", curve.repeat},
          {"timed", curve.timed},     {"points", points},       {"kept", kept}};
}

Curve curve_from(const Json& json) {
  Curve curve{json.at("dataset"), json.at("view"), json.at("mode"), json.at("raster"), json.at("repeat"), {}};
  curve.regime = json.at("regime");
  curve.timed = json.at("timed");
  for (const Json& point : json.at("points")) curve.points.push_back(point_of(point));
  for (const Json& frame : json.at("kept")) curve.kept.push_back({frame.at("frame"), frame.at("file")});
  return curve;
}

}  // namespace stipple
