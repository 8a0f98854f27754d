// The report of a study in a browser, as its readers see it.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/command/run_stipple.h"

namespace stipple::test::report_page {
namespace {

constexpr const char* kBrowser = "/usr/bin/chromium-headless-shell";

std::string replaced(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.rfind(what);
  return at == text.npos ? text : text.replace(at, what.size(), by);
}

std::string unescaped(std::string text) {
  for (const auto& [entity, character] :
       std::vector<std::pair<std::string, std::string>>{{"&lt;", "<"}, {"&gt;", ">"}, {"&amp;", "&"}})
    for (std::size_t at = text.find(entity); at != text.npos; at = text.find(entity, at + 1))
      text.replace(at, entity.size(), character);
  return text;
}

// What tests/report/probe.js finds in a report.
class Report : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kBrowser))
      GTEST_SKIP() << kBrowser << " is missing; scripts/setup installs it (chromium-headless-shell)";
  }
  std::string path(const std::string& name) const { return folder_.path(name); }

  void study(const std::string& arguments) const {
    const Outcome outcome =
        run_stipple(folder_, "study " + city_file(folder_, 20'000) + " --size 160x90 --budget 4k --path-frames 6 " +
                                 arguments + " -o " + path("out"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }

  // Errors of the page are failures here.
  Json checks() const {
    std::string page = text_of(path("out/index.html"));
    page.insert(page.find("<meta charset"),
                "<script>window.pageErrors = [];"
                "addEventListener('error', (e) => pageErrors.push(e.message));"
                "addEventListener('unhandledrejection', (e) => pageErrors.push(String(e.reason)));"
                "for (const kind of ['error', 'warn']) console[kind] = (...all) => pageErrors.push(all.join(' '));"
                "</script>");
    page = replaced(page, "</body>",
                    "<script>" + text_of(std::string(STIPPLE_SOURCE) + "/tests/report/probe.js") + "</script></body>");
    std::ofstream(path("probed.html"), std::ios::binary) << page;
    // In a container there is neither a sandbox nor a /dev/shm of any size
    const std::string command = std::string("HOME=") + path("") + " timeout 100 " + kBrowser +
                                " --no-sandbox --disable-gpu --disable-dev-shm-usage --virtual-time-budget=20000"
                                " --window-size=1300,900 --dump-dom file://" +
                                path("probed.html") + " > " + path("dom.html") + " 2> " + path("browser.log");
    const int status = std::system(command.c_str());
    EXPECT_EQ(status, 0) << text_of(path("browser.log"));
    const std::string dom = text_of(path("dom.html"));
    const std::string opening = "<pre id=\"found\">";
    const std::size_t start = dom.find(opening);
    if (start == dom.npos) {
      ADD_FAILURE() << "the page did not get to its end\n" << text_of(path("browser.log"));
      return {};
    }
    const std::size_t begin = start + opening.size();
    const Json found = Json::parse(unescaped(dom.substr(begin, dom.find("</pre>", begin) - begin)));
    EXPECT_EQ(found.at("errors"), Json::array());
    return found.at("checks");
  }

  const ScratchFolder folder_;
};

const Json& summary_of(const Json& document, const std::string& mode, const std::string& regime) {
  for (const Json& row : document.at("summary"))
    if (row.at("mode") == mode && row.at("regime") == regime) return row;
  throw Error("no summary of " + mode);
}

TEST_F(Report, ShowsTheNumbersOfTheStudyAndCanBeUsed) {
  std::ofstream(path("views.json"))
      << R"({"views": [{"name": "corner", "eye": [564900, 5933900, 200], "target": [565300, 5934300, 0]}]})";
  study("--views " + path("views.json") + " --regime cold,path,stop");
  if (HasFatalFailure()) return;
  const Json document = json_file(path("out/study.json"));
  const Json seen = checks();
  ASSERT_TRUE(seen.is_object());
  EXPECT_EQ(seen.at("external"), Json::array());
  EXPECT_EQ(seen.at("hidden sections"), Json::array());
  const std::string charts = seen.at("charts").dump();
  for (const char* part :
       {"curves: corner, from nothing", "curves: approach, after stopping", "moving: approach: flicker",
        "rates: approach, along the path", "parts: approach, along the path"})
    EXPECT_TRUE(contains(charts, part)) << charts;

  EXPECT_EQ(seen.at("a method off"), Json::array({-1, true, "false"}));
  EXPECT_EQ(seen.at("a method on again"), 0);
  EXPECT_EQ(seen.at("clocks"), Json::array({"points", "time"}));
  EXPECT_EQ(seen.at("lines").at("points").at("axis"), "points drawn [M]");
  EXPECT_EQ(seen.at("lines").at("time").at("axis"), "time of drawing [ms]");

  // Every cell of the table, and the ends of the curves
  for (const char* mode : {"unstructured", "hybrid"}) {
    const Json& row = summary_of(document, mode, "cold");
    for (const char* key : {"30_db", "35_db", "40_db", "45_db", "identical"}) {
      const Json& cell = seen.at("cells").at(mode).at(key);
      const Json& reached = row.at("reached").at(key);
      ASSERT_FALSE(reached.is_null());
      EXPECT_EQ(cell.at("points"), reached.at("points").dump()) << mode << key;
      EXPECT_NEAR(std::stod(cell.at("ms").get<std::string>()), reached.at("ms_median").get<double>(), 1e-9);
    }
  }
  const Json& row = summary_of(document, "unstructured", "cold");
  const Json& by_points = seen.at("lines").at("points").at("line");
  EXPECT_EQ(by_points.size(), row.at("frames"));
  EXPECT_NEAR(by_points.back().at(0).get<double>(), 0.02, 1e-12);
  EXPECT_EQ(by_points.back().at(2), row.at("psnr_db"));
  const Json& holes = seen.at("holes").at("line");
  EXPECT_NEAR(holes.front().at(1).get<double>(), row.at("first").at("hole").get<double>(), 1e-12);
  EXPECT_EQ(seen.at("holes").at("title"), "Holes [share of pixels]");

  for (const Json& chart : seen.at("scatter"))
    if (chart.at(0) == "approach, along the path") {
      EXPECT_EQ(chart.at(1).size(), 6u);
      for (const Json& mark : chart.at(1)) {
        const double ms = summary_of(document, mark.at(0), "path").at("frame_ms").at("p50");
        EXPECT_NEAR(mark.at(1).at("x").get<double>(), 1e3 / ms, 1e-9 / ms);
      }
    }
  for (const Json& chart : seen.at("parts"))
    if (chart.at(0) == "approach, along the path: mean over frames") {
      const auto& modes = chart.at(1);
      for (std::size_t m = 0; m < modes.size(); ++m)
        EXPECT_EQ(chart.at(2).at(2).at(1).at(m), summary_of(document, modes.at(m), "path").at("mean").at("mse_carry"));
    }
}

TEST_F(Report, ComparesPictures) {
  study("--regime cold,path --modes hybrid,unstructured --json");
  if (HasFatalFailure()) return;
  const Json seen = checks();
  ASSERT_TRUE(seen.is_object());
  EXPECT_EQ(seen.at("scenes").size(), 4u);
  EXPECT_EQ(seen.at("left").at(0), "reference");
  EXPECT_TRUE(contains(seen.at("left").at(1), "hybrid, frame 1: 0.00 M points"));
  EXPECT_EQ(seen.at("picture"), Json::array({160, 90}));
  EXPECT_EQ(seen.at("difference").at("class"), "sheet difference");
  EXPECT_GT(seen.at("difference").at("apart"), 0);
  EXPECT_EQ(seen.at("difference").at("same"), 0);
  EXPECT_EQ(seen.at("blinks"), true);
  EXPECT_EQ(seen.at("split"), "25%");
  EXPECT_TRUE(contains(seen.at("opened from the film"), "frame 1"));
  EXPECT_GT(seen.at("film frames"), 10);
  EXPECT_EQ(seen.at("dark"), Json::array({"dark", "rgb(20, 23, 26)"}));
  EXPECT_EQ(seen.at("settings"), true);
  EXPECT_EQ(seen.at("document"), "stipple-study");
}

TEST_F(Report, OfTheClockThatCountsPointsHasNoTimes) {
  study("--regime cold,path --modes hybrid,unstructured --clock points");
  if (HasFatalFailure()) return;
  const Json seen = checks();
  ASSERT_TRUE(seen.is_object());
  EXPECT_EQ(seen.at("clocks"), Json::array({"points"}));
  EXPECT_EQ(seen.at("hidden sections"), Json::array({"rates"}));
  EXPECT_FALSE(seen.at("cells").at("hybrid").at("30_db").contains("ms"));
}

}  // namespace
}  // namespace stipple::test::report_page
