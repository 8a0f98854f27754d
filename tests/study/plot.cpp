// GCC 12 takes a moved std::regex for uninitialised when it also instruments it for a sanitizer.
#ifndef __clang__
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#endif

#include "src/study/plot.h"

#include <gtest/gtest.h>

#include <cctype>
#include <limits>
#include <regex>

namespace stipple::test::study_plot {
namespace {

// `frames` frames whose error falls to zero.
Curve curve_of(const std::string& dataset, const std::string& view, const std::string& mode, int frames = 4) {
  Curve curve{dataset, view, mode, "compute", 0, {}};
  for (int i = 0; i < frames; ++i) {
    CurvePoint point;
    point.state.frame = static_cast<std::uint64_t>(i) + 1;
    point.state.points_drawn = 1'000u * (static_cast<std::uint64_t>(i) + 1);
    point.state.milliseconds = 2.5 * (i + 1);
    point.mse = 100.0 * (frames - 1 - i);
    point.identical = i == frames - 1;
    curve.points.push_back(point);
  }
  return curve;
}

// Empty when every tag is closed in order, attributes are quoted and text holds no bare < or &; else what is wrong.
std::string xml_flaw(const std::string& text) {
  static const std::regex kTag(R"(<(/?)([A-Za-z]+)((?:\s+[A-Za-z0-9:_-]+='[^'<]*')*)\s*(/?)>)");
  static const std::regex kText(R"((?:[^<>&]|&(?:amp|lt|gt|quot|apos);)*)");
  std::vector<std::string> open;
  std::size_t at = 0;
  for (auto tag = std::sregex_iterator(text.begin(), text.end(), kTag); tag != std::sregex_iterator(); ++tag) {
    const std::string between = text.substr(at, static_cast<std::size_t>(tag->position()) - at);
    if (!std::regex_match(between, kText)) return "text: " + between;
    at = static_cast<std::size_t>(tag->position() + tag->length());
    const std::string name = (*tag)[2];
    if ((*tag)[1].length()) {
      if (open.empty() || open.back() != name) return "closes " + name;
      open.pop_back();
    } else if (!(*tag)[4].length()) {
      open.push_back(name);
    }
  }
  if (!open.empty()) return "left open: " + open.back();
  return text.substr(at) == "\n" ? "" : "after the end: " + text.substr(at);
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

TEST(Plot, IsWellFormed) {
  const std::vector<Curve> curves{curve_of("city", "low", "hierarchical"), curve_of("city", "low", "unstructured"),
                                  curve_of("a <b> & \"c\" 'd'", "x", "unstructured")};
  EXPECT_EQ(xml_flaw(plot_svg(curves)), "");
  EXPECT_EQ(xml_flaw(plot_svg({})), "");
}

TEST(Plot, NamesWithControlCharactersStayWellFormed) {
  const std::vector<Curve> curves{curve_of("a\x01\x1F z", "x", "unstructured")};
  for (const char c : plot_svg(curves)) EXPECT_FALSE(std::iscntrl(static_cast<unsigned char>(c)) && c != '\n');
}

TEST(Plot, HasAPathForEachCurveAndClock) {
  const std::vector<Curve> curves{curve_of("city", "low", "hierarchical"), curve_of("city", "low", "unstructured"),
                                  curve_of("city", "aerial", "unstructured")};
  const std::string svg = plot_svg(curves);
  EXPECT_EQ(count_of(svg, "<path "), 6u);
  EXPECT_EQ(count_of(svg, "class='frame'"), 4u);
  EXPECT_EQ(count_of(svg, "city, low"), 1u);
  EXPECT_EQ(count_of(svg, "points drawn"), 2u);
  EXPECT_EQ(count_of(svg, "milliseconds"), 2u);
  // One ring a curve and clock; each mode once in the legend
  EXPECT_EQ(count_of(svg, "<circle "), 6u);
  EXPECT_EQ(count_of(svg, ">hierarchical<"), 1u);
}

TEST(Plot, NumbersStayFiniteWhateverTheCurve) {
  Curve all_equal = curve_of("city", "low", "unstructured", 3);
  for (CurvePoint& point : all_equal.points) {
    point.mse = 50.0;
    point.state.milliseconds = 0.0;
    point.state.points_drawn = 0;
  }
  for (const Curve& curve :
       {curve_of("city", "low", "unstructured", 1), all_equal, Curve{"city", "low", "u", "c", 0, {}}}) {
    const std::string svg = plot_svg({&curve, 1});
    EXPECT_EQ(svg.find("nan"), std::string::npos);
    EXPECT_EQ(svg.find("inf"), std::string::npos);
    EXPECT_EQ(xml_flaw(svg), "");
  }
}

TEST(Plot, ALargeStudyHasABoundedNumberOfTicks) {
  Curve curve = curve_of("city", "low", "unstructured");
  curve.points.back().state.points_drawn = 100'000'000'000ull;
  curve.points.back().state.milliseconds = 1e9;
  EXPECT_LT(count_of(plot_svg({&curve, 1}), "class='tick'"), 60u);
}

}  // namespace
}  // namespace stipple::test::study_plot
