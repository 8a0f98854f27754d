// The viewer in a real window on a display of its own, with real input.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <optional>
#include <string>

#include "render/measure/image.h"
#include "src/viewer/viewer.h"
#include "tests/command/run_stipple.h"
#include "tests/window/x_display.h"

namespace stipple::test {

inline constexpr std::uint64_t kPoints = 60'000;
inline constexpr glm::ivec2 kSize{640, 400};
inline constexpr int kCentreX = 480;  // right of the panel, where points are
inline constexpr int kCentreY = 130;

inline const XDisplay& display() {
  static const XDisplay one;
  return one;
}

class ViewerWindow : public testing::Test {
 protected:
  void SetUp() override {
    if (!display().running()) GTEST_SKIP() << "Xvfb is missing (apt install xvfb): the window is not tested";
    display().move(kCentreX, kCentreY);
    window_.emplace(WindowOptions{.size = kSize, .errors_are_fatal = true});
  }
  void TearDown() override {
    viewer_.reset();
    window_.reset();
  }

  void start(double point_size = 1.0, const std::string& input = "") {
    ViewerOptions options;
    options.inputs = {input.empty() ? city_ : input};
    options.point_size = point_size;
    options.policy.frames_per_second = 30.0;
    viewer_.emplace(*window_, std::move(options));
  }
  // Goes on until it is so.
  [[nodiscard]] bool until(const std::function<bool()>& so) {
    for (int i = 0; i < 3000; ++i) {
      if (so()) return true;
      viewer_->step(0.01);
    }
    return false;
  }
  [[nodiscard]] bool complete() {
    steps(2);  // what has just happened is seen by then
    return until([&] { return viewer_->stage().complete(viewer_->view()) && viewer_->at_rest(); });
  }
  void steps(int count) {
    for (int i = 0; i < count; ++i) viewer_->step(0.01);
  }
  bool covered() {
    const Image image = viewer_->picture();
    const auto grey = std::ranges::count(image.rgb, std::uint8_t{0x80});
    return static_cast<std::size_t>(grey) < image.rgb.size() * 99 / 100;
  }
  // What `stipple render` makes of the command in the clipboard.
  Image headless() {
    viewer_->execute(Command::copy_command);
    std::string command = window_->clipboard();
    EXPECT_TRUE(command.starts_with("stipple render "));
    const std::string picture = folder_.path("headless.png");
    command.replace(command.find("view.png"), 8, picture);
    const Outcome outcome = run_stipple(folder_, command.substr(8));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return read_png(picture);
  }

  const ScratchFolder folder_;
  const std::string city_ = city_file(folder_, kPoints);
  std::optional<Window> window_;
  std::optional<Viewer> viewer_;
};

}  // namespace stipple::test
