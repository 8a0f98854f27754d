// Every method converges to the brute-force picture of its rasterizer.
#include <gtest/gtest.h>

#include <filesystem>
#include <tuple>

#include "octree/core/error.h"
#include "octree/open/open.h"
#include "render/method/progressive_renderer.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_methods {
namespace {

// "index": mode unstructured as S18.
using Progressive = std::tuple<std::string, RasterizerKind>;

class EachMethod : public testing::TestWithParam<Progressive> {
 protected:
  bool by_index() const { return std::get<0>(GetParam()) == "index"; }
  Mode mode() const { return by_index() ? Mode::unstructured : *mode_named(std::get<0>(GetParam())); }
  RasterizerKind rasterizer() const { return std::get<1>(GetParam()); }
  std::unique_ptr<Method> method(const Dataset& dataset, std::uint64_t seed = 0) const {
    return make_method(mode(), dataset.points, &*dataset.octree, {.seed = seed, .carry_indices = by_index()});
  }
};
INSTANTIATE_TEST_SUITE_P(
    Methods, EachMethod,
    testing::Combine(testing::Values("hierarchical", "unstructured", "index", "hybrid", "subsample"),
                     testing::Values(RasterizerKind::points, RasterizerKind::compute)),
    [](const auto& param) { return std::get<0>(param.param) + "_" + std::string(name_of(std::get<1>(param.param))); });

constexpr std::uint64_t kPoints = 60'000;
const char* const kScenes[] = {"city", "terrain", "forest", "interior", "corridor"};

TEST_P(EachMethod, ConvergesToBruteForceOnEveryScene) {
  for (const char* name : kScenes) {
    const Dataset& dataset = scene(name, kPoints);
    const auto drawn = method(dataset);
    for (const char* camera : {"oblique", "low"}) {
      const View view = view_of(dataset, camera);
      EXPECT_TRUE(same_picture(converged_picture(*drawn, rasterizer(), dataset.points.grid, view, 20'000),
                               brute_force_picture(dataset.points, rasterizer(), view)))
          << name << " " << camera;
    }
  }
}

TEST_P(EachMethod, ConvergesToBruteForceForAnyBudgetAndSeed) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  const FrameData expected = brute_force_picture(dataset.points, rasterizer(), view);
  for (const std::uint32_t budget : {4'999u, 7'001u, 59'999u, 60'000u, 1'000'000u})
    for (const std::uint64_t seed : {0ull, 12345678901234567ull})
      EXPECT_TRUE(same_picture(
          converged_picture(*method(dataset, seed), rasterizer(), dataset.points.grid, view, budget), expected))
          << budget << " " << seed;
}

TEST_P(EachMethod, ConvergesInFramesOfSeveralParts) {
  const Dataset& dataset = scene("city", kPoints);
  for (const double eyes_apart : {0.0, 0.5}) {
    const auto drawn = method(dataset);
    ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid);
    if (!renderer.adds_to_frames()) return;
    View view = view_of(dataset, "oblique");
    view.eyes_apart = eyes_apart;
    const auto draw_frame = [&](const View& next) {
      FrameReport report = renderer.draw(next, 4'000);
      for (int part = 0; part < 3 && !report.converged; ++part) {
        report = renderer.draw_more(3'000);
        EXPECT_LE(report.points_filled, 3'000u);
      }
      return report.converged;
    };
    for (int frame = 0; frame < 4; ++frame) {
      View other = view;
      other.eye += view.forward * (20.0 - 5.0 * frame);
      draw_frame(other);
    }
    for (int frame = 0; !draw_frame(view); ++frame) ASSERT_LT(frame, 1'000);
    for (std::size_t eye = 0; eye < view.eyes(); ++eye)
      EXPECT_TRUE(same_picture(renderer.read(eye), brute_force_picture(dataset.points, rasterizer(), view.of_eye(eye))))
          << eyes_apart << " " << eye;
  }
}

// The slots of unstructured are drawn one after the other, whoever asks.
TEST(UnstructuredInParts, DrawsTheFrameOfTheWholeBudget) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  const auto picture = [&](bool in_parts) {
    const auto drawn = make_method(Mode::unstructured, dataset.points, nullptr);
    ProgressiveRenderer renderer(*drawn, RasterizerKind::compute, dataset.points.grid);
    for (int frame = 0; frame < 3; ++frame) {
      View next = view;
      next.eye += view.forward * (5.0 * frame);
      renderer.draw(next, in_parts ? 3'000 : 9'000);
      if (in_parts) renderer.draw_more(5'000);
      if (in_parts) renderer.draw_more(1'000);
    }
    return renderer.read();
  };
  EXPECT_TRUE(same_picture(picture(true), picture(false)));
}

TEST_P(EachMethod, ConvergesToBruteForceWithSplats) {
  const Dataset& dataset = scene("forest", kPoints);
  const View view = view_of(dataset, "oblique");
  EXPECT_TRUE(same_picture(converged_picture(*method(dataset), rasterizer(), dataset.points.grid, view, 20'000, 2.0),
                           brute_force_picture(dataset.points, rasterizer(), view, 2.0)));
}

TEST_P(EachMethod, ConvergesToBruteForceWithNearSplats) {
  const Dataset& dataset = scene("forest", kPoints);
  const View view = view_of(dataset, "low", {160, 90});
  for (const PointSize& point_size : {PointSize(1.0, 0.6), PointSize(2.0, 1.5)}) {
    const auto drawn = method(dataset);
    ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid, point_size);
    // On the way there: what is carried was near and becomes far, and the other way round
    for (int frame = 0; frame < 4; ++frame) {
      View other = view;
      other.eye += view.forward * (20.0 - 10.0 * frame);
      renderer.draw(other, 9'000);
    }
    while (!renderer.draw(view, 20'000).converged) {
    }
    EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, rasterizer(), view, point_size)));
  }
}

TEST_P(EachMethod, ConvergesToBruteForceAfterTheCameraMoved) {
  const Dataset& dataset = scene("city", kPoints);
  const auto moved = method(dataset);
  ProgressiveRenderer renderer(*moved, rasterizer(), dataset.points.grid);
  const View start = view_of(dataset, "oblique");
  View view = start;
  for (int frame = 0; frame < 12; ++frame) {
    view.eye = start.eye + start.right * (5.0 * frame) + start.forward * (9.0 * frame);
    renderer.draw(view, 3'000);
  }
  while (!renderer.draw(view, 11'000).converged) {
  }
  EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, rasterizer(), view)));
}

TEST_P(EachMethod, StillFramesWithoutFillChangeNothing) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  const auto partly = method(dataset);
  ProgressiveRenderer renderer(*partly, rasterizer(), dataset.points.grid);
  for (int frame = 0; frame < 3; ++frame) renderer.draw(view, 5'000);
  const FrameData before = renderer.read();
  ASSERT_GT(before.covered_pixels(), 1'000u);
  for (int frame = 0; frame < 10; ++frame) EXPECT_EQ(renderer.draw(view, 0).points_filled, 0u);
  EXPECT_TRUE(same_picture(renderer.read(), before));
}

TEST_P(EachMethod, DrawsNoMoreThanItsBudget) {
  const Dataset& dataset = scene("city", kPoints);
  const auto drawn = method(dataset);
  ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid);
  const View view = view_of(dataset, "low");
  for (const std::uint32_t budget : {1u, 2u, 77u, 10'000u})
    EXPECT_LE(renderer.draw(view, budget).points_filled, budget);
}

TEST_P(EachMethod, DrawsEachPointAtMostOnceForAStillView) {
  const Dataset& dataset = scene("city", kPoints);
  const auto drawn = method(dataset);
  ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid);
  std::uint64_t filled = 0;
  for (FrameReport report; !report.converged;) {
    report = renderer.draw(view_of(dataset, "oblique"), 7'000);
    filled += report.points_filled;
  }
  EXPECT_LE(filled, kPoints);
}

TEST_P(EachMethod, AnEmptyCloudConvergesToAnEmptyPicture) {
  const PointSet nothing = points_at({});
  const Octree no_tree;
  const auto drawn = make_method(mode(), nothing, &no_tree, {.carry_indices = by_index()});
  EXPECT_EQ(converged_picture(*drawn, rasterizer(), nothing.grid, front_view(2.0), 1000).covered_pixels(), 0u);
}

// The LAS files of the catalogue that open; those that are broken on purpose do not.
const std::vector<Dataset>& real_datasets() {
  static const std::vector<Dataset> datasets = [] {
    std::vector<Dataset> opened;
    const std::filesystem::path data = STIPPLE_SHARED_DATA;
    if (!std::filesystem::exists(data)) return opened;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(data)) {
      if (entry.path().extension() != ".las") continue;
      try {
        opened.push_back(load_dataset(*open_source(entry.path()), "", {.octree = true}));
      } catch (const Error&) {
      }
    }
    return opened;
  }();
  return datasets;
}

TEST_P(EachMethod, ConvergesToBruteForceOnEveryRealFile) {
  if (real_datasets().empty()) GTEST_SKIP() << STIPPLE_SHARED_DATA << " is missing: real files are not tested";
  ASSERT_GT(real_datasets().size(), 90u);
  for (const Dataset& dataset : real_datasets()) {
    const View view = view_of(dataset, "oblique", {160, 90});
    const auto budget = static_cast<std::uint32_t>(dataset.points.size() / 4 + 1);
    EXPECT_TRUE(same_picture(converged_picture(*method(dataset), rasterizer(), dataset.points.grid, view, budget),
                             brute_force_picture(dataset.points, rasterizer(), view)))
        << dataset.info.path;
  }
}

}  // namespace
}  // namespace stipple::test::render_methods
