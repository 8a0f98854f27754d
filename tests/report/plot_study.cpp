// scripts/plot_study, where matplotlib is there.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "tests/command/run_stipple.h"

namespace stipple::test::report_plot_study {
namespace {

class PlotStudy : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("/usr/bin/python3 -c 'import matplotlib' 2>/dev/null") != 0)
      GTEST_SKIP() << "matplotlib is missing (apt-get install python3-matplotlib)";
  }
  std::string path(const std::string& name) const { return folder_.path(name); }
  int plot(const std::string& arguments) const {
    const std::string command = std::string("/usr/bin/python3 ") + STIPPLE_SOURCE + "/scripts/plot_study " + arguments +
                                " >" + path("log") + " 2>&1";
    return WEXITSTATUS(std::system(command.c_str()));
  }
  void study(const std::string& clock) const {
    const Outcome outcome =
        run_stipple(folder_, "study " + city_file(folder_, 5'000) +
                                 " --size 64x48 --budget 1k --path-frames 3 --clock " + clock + " -o " + path("out"));
    ASSERT_EQ(outcome.code, 0) << outcome.err;
  }

  const ScratchFolder folder_;
};

TEST_F(PlotStudy, DrawsTheSameFiguresEachTime) {
  study("wall");
  ASSERT_EQ(plot(path("out")), 0) << text_of(path("log"));
  ASSERT_EQ(plot(path("out") + " -o " + path("again")), 0) << text_of(path("log"));
  for (const char* name : {"quality-points", "quality-time", "rate-quality", "causes", "paths"})
    for (const char* kind : {".svg", ".pdf"}) {
      const std::string figure = text_of(path("out/figures/") + name + kind);
      EXPECT_GT(figure.size(), 1000u) << name << kind;
      EXPECT_EQ(figure, text_of(path("again/") + name + kind)) << name << kind;
    }
  const std::string svg = text_of(path("out/figures/quality-points.svg"));
  for (const char* part : {"hybrid", "oblique, from nothing", "points drawn [M]", "PSNR [dB]"})
    EXPECT_TRUE(contains(svg, part)) << part;
}

TEST_F(PlotStudy, DrawsNoTimesWhereNoneWereTaken) {
  study("points");
  ASSERT_EQ(plot(path("out")), 0) << text_of(path("log"));
  EXPECT_TRUE(std::filesystem::exists(path("out/figures/quality-points.pdf")));
  EXPECT_FALSE(std::filesystem::exists(path("out/figures/quality-time.pdf")));
}

TEST_F(PlotStudy, NamesAStudyThatIsNone) {
  EXPECT_EQ(plot(path("nothing")), 1);
  EXPECT_TRUE(contains(text_of(path("log")), path("nothing/study.json")));
}

}  // namespace
}  // namespace stipple::test::report_plot_study
