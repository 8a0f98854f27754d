// `stipple view` as a command.
#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>

#include "render/measure/image.h"
#include "tests/command/run_stipple.h"
#include "tests/window/viewer_window.h"

namespace stipple::test::window_view_command {
namespace {

TEST(ViewCommand, TakesAScreenshotAndEnds) {
  if (!display().running()) GTEST_SKIP() << "Xvfb is missing (apt install xvfb): the window is not tested";
  const ScratchFolder folder;
  const std::string city = city_file(folder, kPoints);
  const std::string common = city + " --size 320x200 --mode unstructured ";
  const Outcome view =
      run_stipple(folder, "view " + common + "--screenshot " + folder.path("window.png") + " --exit-after-screenshot");
  ASSERT_EQ(view.code, 0) << view.err;
  ASSERT_EQ(run_stipple(folder, "render " + common + "-o " + folder.path("file.png")).code, 0);
  EXPECT_EQ(read_png(folder.path("window.png")).rgb, read_png(folder.path("file.png")).rgb);
}

TEST(ViewCommand, TakesAScreenshotOfAnotherSizeThanTheWindows) {
  if (!display().running()) GTEST_SKIP() << "Xvfb is missing (apt install xvfb): the window is not tested";
  const ScratchFolder folder;
  const std::string city = city_file(folder, kPoints);
  std::ofstream(folder.path("camera.json")) << R"({"eye": [565160, 5934080, 120], "target": [565330, 5934420, 0]})";
  const std::string common = city + " --edl --camera " + folder.path("camera.json");
  const Outcome view =
      run_stipple(folder, "view " + common + " --size 320x200 --screenshot-size 500x700 --screenshot " +
                              folder.path("window.png") + " --exit-after-screenshot");
  ASSERT_EQ(view.code, 0) << view.err;
  ASSERT_EQ(run_stipple(folder, "render " + common + " --size 500x700 -o " + folder.path("file.png")).code, 0);
  EXPECT_EQ(read_png(folder.path("window.png")).size, glm::ivec2(500, 700));
  EXPECT_EQ(read_png(folder.path("window.png")).rgb, read_png(folder.path("file.png")).rgb);
}

TEST(ViewCommand, PicturesTheWindowAsItIs) {
  if (!display().running()) GTEST_SKIP() << "Xvfb is missing (apt install xvfb): the window is not tested";
  const ScratchFolder folder;
  const std::string city = city_file(folder, kPoints);
  const std::string picture = folder.path("window.png");
  const Outcome view = run_stipple(
      folder, "view " + city + " --size 640x400 --screenshot " + picture + " --with-panels --exit-after-screenshot");
  ASSERT_EQ(view.code, 0) << view.err;
  const Image image = read_png(picture);
  ASSERT_EQ(image.size, glm::ivec2(640, 400));
  // Dark where the panel is, grey in the upper right corner
  const std::size_t in_panel = 3 * (20 * 640 + 285);
  EXPECT_LT(image.rgb[in_panel], 0x50);
  EXPECT_EQ(image.rgb[3 * (5 * 640 + 635)], 0x80);
}

TEST(ViewCommand, SaysWhatToDoWithoutADisplay) {
  const ScratchFolder folder;
  const std::string city = city_file(folder, 1'000);
  const std::string saved = std::getenv("DISPLAY") ? std::getenv("DISPLAY") : "";
  ::unsetenv("DISPLAY");
  const Outcome outcome = run_stipple(folder, "view " + city);
  if (!saved.empty()) ::setenv("DISPLAY", saved.c_str(), 1);
  EXPECT_EQ(outcome.code, 1);
  EXPECT_NE(outcome.err.find("xvfb-run"), std::string::npos);
  EXPECT_EQ(run_stipple(folder, "view " + folder.path("none.las")).code, 1);
  EXPECT_EQ(run_stipple(folder, "view " + city + " --mode reference").code, 2);
  EXPECT_EQ(run_stipple(folder, "view " + city + " --exit-after-screenshot").code, 2);
}

}  // namespace
}  // namespace stipple::test::window_view_command
