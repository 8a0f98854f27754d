// Two eyes: one selection, and a picture for each that is right by itself.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>
#include <tuple>

#include "render/method/progressive_renderer.h"
#include "render/store/gpu_cloud.h"
#include "src/run/view_run.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_stereo {
namespace {

constexpr std::uint32_t kPoints = 60'000;  // of scenes that other tests make, too

View two_eyes(View view, double apart) {
  view.eyes_apart = apart;
  return view;
}

// "index": mode unstructured as S18.
class EachMethodInStereo : public testing::TestWithParam<std::tuple<std::string, RasterizerKind>> {
 protected:
  RasterizerKind rasterizer() const { return std::get<1>(GetParam()); }
  std::unique_ptr<Method> method(const Dataset& dataset) const {
    const std::string& name = std::get<0>(GetParam());
    const Mode mode = name == "index" ? Mode::unstructured : *mode_named(name);
    return make_method(mode, dataset.points, &*dataset.octree, {.carry_indices = name == "index"});
  }
  // Draws until converged: the points that were streamed.
  std::uint64_t converge(ProgressiveRenderer& renderer, const View& view) const {
    // Mode lod draws as much as the budget holds, and no more
    const std::uint32_t budget = std::get<0>(GetParam()) == "lod" ? kPoints : 9'000;
    std::uint64_t filled = 0;
    for (FrameReport report; !report.converged; filled += report.points_filled) report = renderer.draw(view, budget);
    return filled;
  }
  void expect_brute_force(ProgressiveRenderer& renderer, const Dataset& dataset, const View& view) const {
    for (std::size_t eye = 0; eye < view.eyes(); ++eye)
      EXPECT_TRUE(same_picture(renderer.read(eye), brute_force_picture(dataset.points, rasterizer(), view.of_eye(eye))))
          << "eye " << eye;
  }
};
INSTANTIATE_TEST_SUITE_P(Methods, EachMethodInStereo,
                         testing::Combine(testing::Values("brute-force", "hierarchical", "unstructured", "index",
                                                          "hybrid", "lod", "subsample"),
                                          testing::Values(RasterizerKind::points, RasterizerKind::compute)),
                         [](const auto& param) {
                           std::string name =
                               std::get<0>(param.param) + "_" + std::string(name_of(std::get<1>(param.param)));
                           std::ranges::replace(name, '-', '_');
                           return name;
                         });

TEST_P(EachMethodInStereo, EachEyeConvergesToBruteForceWhereverItWas) {
  const Dataset& dataset = scene("city", kPoints);
  const auto drawn = method(dataset);
  ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid);
  const View view = view_of(dataset, "low", {80, 60});
  // From one eye to two, on the way
  View other = view;
  for (int frame = 0; frame < 6; ++frame) {
    other.eye = view.eye + view.forward * (9.0 * frame) + view.right * (5.0 * frame);
    other.eyes_apart = frame < 2 ? 0.0 : 0.5 * frame;
    renderer.draw(other, 4'000);
  }
  for (const double apart : {0.4, 60.0}) {
    EXPECT_LE(converge(renderer, two_eyes(view, apart)), kPoints);
    expect_brute_force(renderer, dataset, two_eyes(view, apart));
    const FrameReport again = renderer.draw(two_eyes(view, apart), 9'000);
    EXPECT_TRUE(again.converged);
    EXPECT_EQ(again.points_filled, 0u);
  }
  // And back to one
  converge(renderer, view);
  expect_brute_force(renderer, dataset, view);
}

class EachRasterizerInStereo : public testing::TestWithParam<RasterizerKind> {};
INSTANTIATE_TEST_SUITE_P(Rasterizers, EachRasterizerInStereo,
                         testing::Values(RasterizerKind::points, RasterizerKind::compute),
                         [](const auto& param) { return std::string(name_of(param.param)); });

// Those methods that ask how large points are on the screen.
TEST_P(EachRasterizerInStereo, EachEyeConvergesToBruteForceWithNearSplats) {
  const Dataset& dataset = scene("forest", kPoints);
  const PointSize point_size(2.0, 1.5);
  const View view = two_eyes(view_of(dataset, "low", {80, 60}), 3.0);
  for (const Mode mode : {Mode::hierarchical, Mode::hybrid, Mode::lod}) {
    const auto method = make_method(mode, dataset.points, &*dataset.octree);
    ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid, point_size);
    while (!renderer.draw(view, mode == Mode::lod ? kPoints : 20'000).converged) {
    }
    for (std::size_t eye = 0; eye < 2; ++eye)
      EXPECT_TRUE(same_picture(renderer.read(eye),
                               brute_force_picture(dataset.points, GetParam(), view.of_eye(eye), point_size)))
          << name_of(mode) << " " << eye;
  }
}

// Draws the points in the order they have, and counts how often it is asked for some.
class CountedSelections final : public Method {
 public:
  explicit CountedSelections(const PointSet& points) : cloud_(upload_in_order(points)) {}

  Carry carry() const override { return Carry::grid; }
  void start_view(const View&) override {}
  Selection select(std::uint32_t budget) override {
    ++selections;
    Selection selection;
    selection.points = std::min<std::size_t>(budget, cloud_.size() - cursor_);
    cloud_.append_items(cursor_, selection.points, selection.items);
    cursor_ += selection.points;
    return selection;
  }
  bool finished() const override { return cursor_ == cloud_.size(); }

  int selections = 0;

 private:
  GpuCloud cloud_;
  std::size_t cursor_ = 0;
};

TEST_P(EachRasterizerInStereo, BothEyesShowTheSameSelection) {
  const PointSet points = random_points(9'000, 500, 5);
  CountedSelections method(points);
  ProgressiveRenderer renderer(method, GetParam(), points.grid);
  const View view = two_eyes(front_view(2.0, {80, 60}), 0.1);
  for (std::uint32_t streamed = 2'000, frame = 1; streamed <= 8'000; streamed += 2'000, ++frame) {
    EXPECT_EQ(renderer.draw(view, 2'000).points_filled, 2'000u);
    EXPECT_EQ(method.selections, static_cast<int>(frame));
    PointSet so_far = points;
    so_far.points.resize(streamed);
    for (std::size_t eye = 0; eye < 2; ++eye)
      EXPECT_TRUE(same_picture(renderer.read(eye), brute_force_picture(so_far, GetParam(), view.of_eye(eye))));
  }
}

TEST_P(EachRasterizerInStereo, ASecondEyeBeginsWithWhatTheFirstSaw) {
  const PointSet points = random_points(9'000, 500, 6);
  CountedSelections method(points);
  ProgressiveRenderer renderer(method, GetParam(), points.grid);
  const View view = front_view(2.0, {80, 60});
  renderer.draw(view, 5'000);
  const std::uint64_t covered = renderer.covered_pixels();
  renderer.draw(two_eyes(view, 0.1), 0);
  EXPECT_EQ(renderer.points_reprojected(0), covered);
  EXPECT_EQ(renderer.points_reprojected(1), covered);
  EXPECT_GT(renderer.covered_pixels(0), covered / 2);
  EXPECT_GT(renderer.covered_pixels(1), covered / 2);
}

TEST_P(EachRasterizerInStereo, ARunCountsWhatBothEyesDraw) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = two_eyes(view_of(dataset, "oblique", {80, 60}), 20.0);
  const auto method = make_method(Mode::unstructured, dataset.points, nullptr);
  ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid);
  std::vector<EyeState> before(2);
  std::vector<std::uint64_t> reprojected(2);
  const FrameState end =
      run_view(renderer, view, {.points = 20'000, .frames_per_second = {}}, {}, [&](const FrameState& state) {
        for (std::size_t eye = 0; eye < 2; ++eye) {
          reprojected[eye] += before[eye].covered_pixels;  // all of them are drawn again
          EXPECT_EQ(state.eyes[eye].points_reprojected, reprojected[eye]);
          EXPECT_EQ(state.eyes[eye].covered_pixels, renderer.read(eye).covered_pixels());
        }
        before = state.eyes;
      });
  EXPECT_EQ(end.points_drawn, kPoints);
  EXPECT_GT(reprojected[0], 0u);
  EXPECT_NE(end.eyes[0].covered_pixels, end.eyes[1].covered_pixels);
  EXPECT_EQ(end.covered_pixels, end.eyes[0].covered_pixels + end.eyes[1].covered_pixels);
  EXPECT_EQ(end.points_reprojected, reprojected[0] + reprojected[1]);
  EXPECT_EQ(end.points_in_views(), 2 * kPoints + reprojected[0] + reprojected[1]);
}

// A wall, and another half a unit behind its left half: wholly hidden from the left eye, in part from the right one.
PointSet wall_before_another(int points_each) {
  std::mt19937 random(9);
  std::uniform_int_distribution<int> front(-600, 0);
  std::uniform_int_distribution<int> back(-300, 0);
  std::uniform_int_distribution<int> height(-300, 300);
  std::vector<glm::ivec3> positions;
  for (int i = 0; i < points_each; ++i) positions.push_back({front(random), 0, 2 * height(random)});
  for (int i = 0; i < points_each; ++i) positions.push_back({back(random), 500, height(random)});
  return points_at(positions);
}

TEST_P(EachRasterizerInStereo, HybridLeavesOutWhatIsHiddenFromBothEyes) {
  constexpr int kEach = 25'000;
  const PointSet points = wall_before_another(kEach);
  const View view = two_eyes(front_view(1.5, {64, 48}), 1.0);
  const auto streamed = [&](const View& seen) {
    const auto method = make_method(Mode::hybrid, points, nullptr);
    ProgressiveRenderer renderer(*method, GetParam(), points.grid);
    std::uint64_t filled = 0;
    for (FrameReport report; !report.converged; filled += report.points_filled) report = renderer.draw(seen, 5'000);
    for (std::size_t eye = 0; eye < seen.eyes(); ++eye)
      EXPECT_TRUE(same_picture(renderer.read(eye), brute_force_picture(points, GetParam(), seen.of_eye(eye))));
    EXPECT_GT(method->counts().nodes_occluded, 20u);
    return filled;
  };
  const std::uint64_t left = streamed(view.of_eye(0));
  const std::uint64_t both = streamed(view);
  EXPECT_LT(both, 2u * kEach);
  EXPECT_GT(both, left);
}

}  // namespace
}  // namespace stipple::test::render_stereo
