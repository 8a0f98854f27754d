#include "render/frame/eye_dome.h"

#include <gtest/gtest.h>

#include <cmath>

#include "render/method/progressive_renderer.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_eye_dome {
namespace {

// By the formula, in double precision.
std::uint32_t shaded(const FrameData& frame, const glm::ivec2& pixel, const EyeDomeOptions& options) {
  const auto at = [&](const glm::ivec2& p) { return static_cast<std::size_t>(p.y * frame.size.x + p.x); };
  const std::size_t here = at(pixel);
  if (frame.ids[here] == kNoPoint) return 0;
  double sum = 0.0;
  for (int i = 0; i < 8; ++i) {
    const double angle = 2.0 * M_PI * i / 8.0;
    const glm::ivec2 away(std::lround(options.radius * std::cos(angle)), std::lround(options.radius * std::sin(angle)));
    const std::size_t there = at(glm::clamp(pixel + away, glm::ivec2(0), frame.size - 1));
    if (frame.ids[there] != kNoPoint) sum += std::max(0.0, std::log2(double(frame.depth[here]) / frame.depth[there]));
  }
  const double light = std::exp(-300.0 * options.strength * sum / 8.0);
  std::uint32_t rgba = 0xFF000000u;
  for (int c = 0; c < 3; ++c)
    rgba |= static_cast<std::uint32_t>((frame.rgba[here] >> (8 * c) & 0xFFu) * light + 0.5) << (8 * c);
  return rgba;
}

int difference(std::uint32_t a, std::uint32_t b) {
  int most = 0;
  for (int c = 0; c < 32; c += 8) most = std::max(most, std::abs(int(a >> c & 0xFFu) - int(b >> c & 0xFFu)));
  return most;
}

class EyeDomeOf : public testing::TestWithParam<RasterizerKind> {};
INSTANTIATE_TEST_SUITE_P(Rasterizers, EyeDomeOf, testing::Values(RasterizerKind::points, RasterizerKind::compute),
                         [](const auto& param) { return std::string(name_of(param.param)); });

TEST_P(EyeDomeOf, DarkensByWhatIsInFrontAndLeavesTheFrameAlone) {
  const Dataset& dataset = scene("city", 60'000);
  const View view = view_of(dataset, "oblique", {161, 89});
  const auto method = make_method(Mode::brute_force, dataset);
  ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid, 3.0);
  renderer.draw(view, 1'000'000);
  const FrameData frame = renderer.read();
  ASSERT_GT(frame.covered_pixels(), 1000u);
  ASSERT_LT(frame.covered_pixels(), frame.pixels());
  EyeDome eye_dome;
  for (const EyeDomeOptions& options : {EyeDomeOptions{}, EyeDomeOptions{.strength = 0.02, .radius = 4.0}}) {
    const std::vector<std::uint32_t> rgba = read_colors(eye_dome.shade(*renderer.frame(), options));
    std::size_t darker = 0;
    for (int y = 0; y < frame.size.y; ++y)
      for (int x = 0; x < frame.size.x; ++x) {
        const auto i = static_cast<std::size_t>(y * frame.size.x + x);
        ASSERT_LE(difference(rgba[i], shaded(frame, {x, y}, options)), 1) << x << ' ' << y;
        darker += rgba[i] != frame.rgba[i];
      }
    EXPECT_GT(darker, 500u);
  }
  EXPECT_TRUE(same_picture(renderer.read(), frame));
}

}  // namespace
}  // namespace stipple::test::render_eye_dome
