// The two estimates by which mode hierarchical rations its points.
#include <gtest/gtest.h>

#include <random>

#include "render/method/progressive_renderer.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_density {
namespace {

// Points close together in a few places of a large volume: what an even spread promises too much of.
Dataset knots() {
  std::mt19937 random(11);
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  std::vector<glm::ivec3> places;
  for (int i = 0; i < 40; ++i) places.push_back({number(-700, 700), number(-700, 700), number(-700, 700)});
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < 40'000; ++i)
    positions.push_back(places[static_cast<std::size_t>(i % 40)] +
                        glm::ivec3(number(-3, 3), number(-3, 3), number(-3, 3)));
  Dataset dataset;
  dataset.points = points_at(positions);
  add_octree(dataset);
  return dataset;
}

TEST(Density, EitherEndsWithTheSamePictureAndUniformPromisesMorePixels) {
  const Dataset dataset = knots();
  const View view = front_view(2.0, {160, 90});
  const FrameData expected = brute_force_picture(dataset.points, RasterizerKind::compute, view);
  const auto covered = static_cast<double>(expected.covered_pixels());
  double estimated[2];
  for (const DensityEstimate density : {DensityEstimate::box_count, DensityEstimate::uniform}) {
    const auto method = make_method(Mode::hierarchical, dataset.points, &*dataset.octree, {.density = density});
    EXPECT_TRUE(
        same_picture(converged_picture(*method, RasterizerKind::compute, dataset.points.grid, view, 5'000), expected));
    estimated[static_cast<int>(density)] = method->counts().pixels_estimated;
  }
  EXPECT_GT(estimated[0], covered / 3.0);
  EXPECT_LT(estimated[0], covered * 6.0);
  EXPECT_GT(estimated[1], estimated[0] * 2.0);
}

}  // namespace
}  // namespace stipple::test::render_density
