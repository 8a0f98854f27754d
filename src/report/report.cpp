#include "src/report/report.h"

#include <string_view>

#include "render/measure/psnr.h"
#include "src/report/assets.h"
#include "src/report/pictures.h"
#include "src/run/provenance.h"

namespace stipple {
namespace {

// Frames of a curve that a chart has room for.
constexpr std::size_t kMostFrames = 400;

Json json_of(const std::optional<double>& value) {
  return value ? Json(*value) : Json();
}

// A list for each column; of a long curve so many frames, evenly, that it can be drawn.
Json columns_of(const Curve& curve) {
  Json columns;
  const std::size_t step = (curve.points.size() + kMostFrames - 1) / kMostFrames;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    if (i % step != 0 && i + 1 != curve.points.size()) continue;
    const CurvePoint& point = curve.points[i];
    const FrameState& state = point.state;
    const double before = i ? curve.points[i - 1].state.milliseconds : 0.0;
    columns["frame"].push_back(state.frame);
    columns["points_drawn"].push_back(state.points_drawn);
    if (curve.timed) columns["ms"].push_back(state.milliseconds);
    if (curve.timed) columns["frame_ms"].push_back(state.milliseconds - before);
    columns["psnr_db"].push_back(json_of_any(psnr_db(point.mse)));
    columns["psnr_covered_db"].push_back(json_of_any(psnr_db(point.covered_mse)));
    columns["ssim"].push_back(json_of(point.ssim));
    columns["flip"].push_back(json_of(point.flip));
    columns["hole"].push_back(point.rates.hole);
    columns["see_through"].push_back(point.rates.see_through);
    columns["ghost"].push_back(point.rates.ghost);
    columns["wrong_point"].push_back(point.rates.wrong_point);
    columns["reuse"].push_back(json_of(point.reuse));
    columns["flicker"].push_back(json_of(point.flicker));
  }
  return columns;
}

Json data_of(const Json& document, std::span<const Curve> curves, const std::string& folder) {
  std::map<std::string, std::uint64_t> points_total;
  for (const Json& dataset : document["datasets"]) points_total[dataset["name"]] = dataset["points_total"];
  ReportPictures pictures = report_pictures(folder, curves, points_total);
  Json list = Json::array();
  for (const Curve& curve : curves)
    list.push_back({{"dataset", curve.dataset},
                    {"regime", curve.regime},
                    {"view", curve.view},
                    {"mode", curve.mode},
                    {"repeat", curve.repeat},
                    {"columns", columns_of(curve)}});
  return {{"study", document},
          {"curves", list},
          {"scenes", pictures.scenes},
          {"picture_scale", pictures.scale},
          {"pictures", pictures.uris}};
}

// JSON that cannot end the element it stands in.
std::string script_safe(const Json& data) {
  std::string safe;
  for (const char c : text_of(data)) {
    if (c == '<')
      safe += "\\u003c";
    else
      safe += c;
  }
  return safe;
}

}  // namespace

std::string report_html(const Json& document, std::span<const Curve> curves, const std::string& folder) {
  std::string script;
  for (const char* file : {"data.js", "charts.js", "tables.js", "pictures.js", "page.js"}) script += report_asset(file);
  const std::map<std::string_view, std::string> parts{{"style", std::string(report_asset("page.css"))},
                                                      {"library", std::string(report_asset("chart.min.js"))},
                                                      {"script", script},
                                                      {"data", script_safe(data_of(document, curves, folder))}};
  // Each {{name}} of the page gives way to that part
  std::string html;
  std::string_view page = report_asset("page.html");
  for (std::size_t at = page.find("{{"); at != page.npos; at = page.find("{{")) {
    const std::size_t end = page.find("}}", at);
    html += page.substr(0, at);
    html += parts.at(page.substr(at + 2, end - at - 2));
    page.remove_prefix(end + 2);
  }
  return html += page;
}

}  // namespace stipple
