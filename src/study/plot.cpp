#include "src/study/plot.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>
#include <vector>

#include "render/measure/psnr.h"

namespace stipple {
namespace {

constexpr double kPanelWidth = 420.0;
constexpr double kPanelHeight = 240.0;
constexpr double kMarginLeft = 58.0;
constexpr double kMarginTop = 46.0;
constexpr double kGapX = 70.0;
constexpr double kGapY = 84.0;
constexpr double kLegendHeight = 34.0;

// Told apart by colour-blind eyes too (Okabe and Ito 2008). Each mode has its own, here and in the report.
const char* color_of(const std::string& mode) {
  if (mode == "brute-force") return "#5D6670";
  if (mode == "hierarchical") return "#0072B2";
  if (mode == "unstructured") return "#D55E00";
  if (mode == "hybrid") return "#009E73";
  return "#CC79A7";
}

struct Axis {
  double low = 0.0;
  double high = 1.0;
  double step = 1.0;
};

// Round steps of 1, 2 or 5 times a power of ten, about five of them.
Axis nice_axis(double low, double high) {
  if (!(high > low)) high = low + 1.0;
  const double rough = (high - low) / 5.0;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10.0 * power;
  for (const double factor : {5.0, 2.0, 1.0})
    if (factor * power >= rough) step = factor * power;
  return {std::floor(low / step) * step, std::ceil(high / step) * step, step};
}

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (static_cast<unsigned char>(c) < 0x20)
      out += ' ';  // XML 1.0 has no control characters
    else
      out += c;
  }
  return out;
}

std::string label(double value) {
  if (value >= 1e6) return fmt::format("{:g} M", value / 1e6);
  if (value >= 1e4) return fmt::format("{:g} k", value / 1e3);
  return fmt::format("{:g}", value);
}

using Work = std::function<double(const FrameState&)>;

double points_of(const FrameState& state) {
  return static_cast<double>(state.points_drawn);
}
double ms_of(const FrameState& state) {
  return state.milliseconds;
}

// Rows of the figure: consecutive curves of one dataset, view and regime.
std::vector<std::span<const Curve>> rows_of(std::span<const Curve> curves) {
  std::vector<std::span<const Curve>> rows;
  for (std::size_t first = 0; first < curves.size();) {
    std::size_t end = first;
    while (end < curves.size() && curves[end].dataset == curves[first].dataset &&
           curves[end].view == curves[first].view && curves[end].regime == curves[first].regime)
      ++end;
    rows.push_back(curves.subspan(first, end - first));
    first = end;
  }
  return rows;
}

std::vector<std::string> modes_of(std::span<const Curve> curves) {
  std::vector<std::string> modes;
  for (const Curve& curve : curves)
    if (std::ranges::find(modes, curve.mode) == modes.end()) modes.push_back(curve.mode);
  return modes;
}

class Panel {
 public:
  Panel(std::string& svg, double left, double top, const Axis& x, const Axis& y)
      : svg_(svg), left_(left), top_(top), x_(x), y_(y) {}

  void draw_frame(const std::string& x_name, const std::string& title) {
    svg_ += fmt::format("<rect x='{:.1f}' y='{:.1f}' width='{}' height='{}' class='frame'/>\n", left_, top_,
                        kPanelWidth, kPanelHeight);
    svg_ += fmt::format("<text x='{:.1f}' y='{:.1f}' class='title'>{}</text>\n", left_, top_ - 10, escaped(title));
    svg_ += fmt::format("<text x='{:.1f}' y='{:.1f}' class='name' text-anchor='middle'>{}</text>\n",
                        left_ + kPanelWidth / 2, top_ + kPanelHeight + 36, x_name);
    svg_ += fmt::format(
        "<text transform='translate({:.1f} {:.1f}) rotate(-90)' class='name' text-anchor='middle'>PSNR "
        "[dB]</text>\n",
        left_ - 40, top_ + kPanelHeight / 2);
    for (double v = x_.low; v <= x_.high + x_.step / 2; v += x_.step)
      svg_ += fmt::format("<text x='{:.1f}' y='{:.1f}' class='tick' text-anchor='middle'>{}</text>\n", px(v),
                          top_ + kPanelHeight + 17, label(v));
    for (double v = y_.low; v <= y_.high + y_.step / 2; v += y_.step)
      svg_ += fmt::format(
          "<line x1='{:.1f}' x2='{:.1f}' y1='{:.1f}' y2='{:.1f}' class='grid'/>"
          "<text x='{:.1f}' y='{:.1f}' class='tick' text-anchor='end'>{}</text>\n",
          left_, left_ + kPanelWidth, py(v), py(v), left_ - 7, py(v) + 4, label(v));
  }

  void draw_curve(const Curve& curve, const Work& work, const char* color) {
    std::string path;
    for (const CurvePoint& point : curve.points)
      path += fmt::format("{}{:.1f},{:.1f} ", path.empty() ? "M" : "L", px(work(point.state)), py(psnr_db(point.mse)));
    svg_ += fmt::format("<path d='{}' stroke='{}' class='curve'/>\n", path, color);
    for (const CurvePoint& point : curve.points)
      if (point.identical || curve.points.size() == 1)
        svg_ += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='4' stroke='{}' class='identical'/>\n",
                            px(work(point.state)), py(psnr_db(point.mse)), color);
  }

 private:
  double px(double v) const { return left_ + kPanelWidth * (v - x_.low) / (x_.high - x_.low); }
  double py(double v) const {
    return top_ + kPanelHeight * (1.0 - (std::clamp(v, y_.low, y_.high) - y_.low) / (y_.high - y_.low));
  }

  std::string& svg_;
  double left_;
  double top_;
  Axis x_;
  Axis y_;
};

// Finite decibels of a row decide its vertical axis; infinite ones stand on its upper edge.
Axis psnr_axis(std::span<const Curve> row) {
  double low = INFINITY;
  double high = -INFINITY;
  for (const Curve& curve : row)
    for (const CurvePoint& point : curve.points)
      if (const double db = psnr_db(point.mse); std::isfinite(db)) {
        low = std::min(low, db);
        high = std::max(high, db);
      }
  return low <= high ? nice_axis(low, high) : Axis{0.0, 60.0, 10.0};
}

Axis work_axis(std::span<const Curve> row, const Work& work) {
  double most = 0.0;
  for (const Curve& curve : row)
    for (const CurvePoint& point : curve.points) most = std::max(most, work(point.state));
  return nice_axis(0.0, most);
}

}  // namespace

std::string plot_svg(std::span<const Curve> curves) {
  const auto rows = rows_of(curves);
  const auto modes = modes_of(curves);
  const double width = kMarginLeft + 2 * kPanelWidth + kGapX + 24;
  const double height = kLegendHeight + kMarginTop + static_cast<double>(rows.size()) * (kPanelHeight + kGapY);
  std::string svg = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' width='{0}' height='{1}' viewBox='0 0 {0} {1}' "
      "font-family='sans-serif'>\n<style>.frame{{fill:none;stroke:#444}} .grid{{stroke:#ddd}} .title{{font-size:14px;"
      "font-weight:bold}} .name{{font-size:12px}} .tick{{font-size:11px;fill:#444}} .curve{{fill:none;stroke-width:2}} "
      ".identical{{fill:white;stroke-width:2}}</style>\n<rect width='100%' height='100%' fill='white'/>\n",
      width, height);

  // Legend
  for (std::size_t m = 0; m < modes.size(); ++m)
    svg += fmt::format(
        "<line x1='{0}' x2='{1}' y1='20' y2='20' stroke='{2}' stroke-width='3'/>"
        "<text x='{3}' y='24' class='name'>{4}</text>\n",
        kMarginLeft + 150.0 * static_cast<double>(m), kMarginLeft + 150.0 * static_cast<double>(m) + 24,
        color_of(modes[m]), kMarginLeft + 150.0 * static_cast<double>(m) + 30, modes[m]);
  svg += fmt::format("<text x='{}' y='24' class='name' text-anchor='end'>ringed: equal to brute force</text>\n",
                     width - 24);

  for (std::size_t r = 0; r < rows.size(); ++r) {
    const double top = kLegendHeight + kMarginTop + static_cast<double>(r) * (kPanelHeight + kGapY);
    const Axis psnr = psnr_axis(rows[r]);
    const Curve& first = rows[r].front();
    const std::string title =
        first.dataset + ", " + first.view + (first.regime == "cold" ? "" : " (" + first.regime + ")");
    const std::array<std::pair<Work, const char*>, 2> clocks{{{points_of, "points drawn"}, {ms_of, "milliseconds"}}};
    for (std::size_t c = 0; c < (first.timed ? clocks.size() : 1); ++c) {
      Panel panel(svg, kMarginLeft + static_cast<double>(c) * (kPanelWidth + kGapX), top,
                  work_axis(rows[r], clocks[c].first), psnr);
      panel.draw_frame(clocks[c].second, c == 0 ? title : "");
      for (const Curve& curve : rows[r]) panel.draw_curve(curve, clocks[c].first, color_of(curve.mode));
    }
  }
  return svg + "</svg>\n";
}

}  // namespace stipple
