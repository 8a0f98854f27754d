// Switching the method in the middle of a picture.
#include <gtest/gtest.h>

#include "render/method/progressive_renderer.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_toggle {
namespace {

constexpr std::uint64_t kPoints = 60'000;

class Toggle : public testing::TestWithParam<RasterizerKind> {
 protected:
  // One of each mode, and S18.
  std::vector<std::unique_ptr<Method>> methods(const Dataset& dataset) const {
    std::vector<std::unique_ptr<Method>> made;
    for (const Mode mode : all_modes()) made.push_back(make_method(mode, dataset.points, &*dataset.octree));
    made.push_back(make_method(Mode::unstructured, dataset.points, &*dataset.octree, {.carry_indices = true}));
    return made;
  }
};
INSTANTIATE_TEST_SUITE_P(Rasterizers, Toggle, testing::Values(RasterizerKind::points, RasterizerKind::compute),
                         [](const auto& param) { return std::string(name_of(param.param)); });

TEST_P(Toggle, LosesNoPoint) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  const auto made = methods(dataset);
  for (const auto& from : made)
    for (const auto& to : made) {
      const bool starts_from_nothing = to == made[0] || to == made[4] || to == made[5];  // brute-force, lod, subsample
      if (from == to || starts_from_nothing) continue;
      ProgressiveRenderer renderer(*from, GetParam(), dataset.points.grid);
      for (int frame = 0; frame < 3; ++frame) renderer.draw(view, 5'000);
      const FrameData before = renderer.read();
      ASSERT_GT(before.covered_pixels(), 1'000u);
      renderer.use(*to);
      renderer.draw(view, 0);
      EXPECT_TRUE(same_picture(renderer.read(), before)) << &from - made.data() << " to " << &to - made.data();
    }
}

TEST_P(Toggle, ConvergesToBruteForceOnTheMove) {
  const Dataset& dataset = scene("city", kPoints);
  View view = view_of(dataset, "oblique");
  const glm::dvec3 step = view.right * 3.0 + view.forward * 2.0;
  const auto made = methods(dataset);
  ProgressiveRenderer renderer(*made.front(), GetParam(), dataset.points.grid);
  for (const std::size_t next : {1, 2, 3, 6, 1, 3, 2, 6, 1, 0, 3, 4, 5, 6, 3}) {
    renderer.use(*made[next]);
    for (int frame = 0; frame < 3; ++frame) {
      view.eye += step;
      renderer.draw(view, 4'000);
      EXPECT_GT(renderer.covered_pixels(), 1'000u);
    }
  }
  while (!renderer.draw(view, 7'000).converged) {
  }
  EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, GetParam(), view)));
}

TEST_P(Toggle, AnotherSizeGoesOnFromThePictureThatIsThere) {
  const Dataset& dataset = scene("city", kPoints);
  for (const auto& method : methods(dataset)) {
    if (method->carry() == Carry::none) continue;
    ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid);
    const View last = view_of(dataset, "oblique", {300, 170});
    for (const glm::ivec2& size : {glm::ivec2(320, 180), glm::ivec2(160, 90), glm::ivec2(161, 90), last.size}) {
      const View view = view_of(dataset, "oblique", size);
      for (int frame = 0; frame < 2; ++frame) renderer.draw(view, 10'000);
      ASSERT_EQ(renderer.read().size, size);
      const std::uint64_t covered = renderer.covered_pixels();
      renderer.draw(view_of(dataset, "oblique", size + 1), 0);
      // Where points of neighbouring pixels fall together some are gone
      EXPECT_GT(renderer.covered_pixels(), covered / 2) << size.x;
    }
    while (!renderer.draw(last, 20'000).converged) {
    }
    EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, GetParam(), last)));
  }
}

}  // namespace
}  // namespace stipple::test::render_toggle
