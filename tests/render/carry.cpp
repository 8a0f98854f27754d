// What a frame takes over from the one before: the same whichever way it is carried, and never anything lost.
#include <gtest/gtest.h>

#include <chrono>
#include <random>

#include "octree/build/builder.h"
#include "render/method/progressive_renderer.h"
#include "render/store/gpu_cloud.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_carry {
namespace {

// Draws the points in the order they have, carrying the last frame as told.
class InOrder final : public Method {
 public:
  InOrder(const PointSet& points, Carry carry) : cloud_(upload_in_order(points)), carry_(carry) {}

  Carry carry() const override { return carry_; }
  void start_view(const View&) override { left_ = cloud_.size(); }
  Selection select(std::uint32_t budget) override {
    Selection selection;
    selection.points = std::min<std::size_t>({budget, left_, cloud_.size() - cursor_});
    cloud_.append_items(cursor_, selection.points, selection.items);
    cursor_ = (cursor_ + selection.points) % cloud_.size();
    left_ -= selection.points;
    return selection;
  }
  bool finished() const override { return left_ == 0; }

 private:
  GpuCloud cloud_;
  Carry carry_;
  std::size_t cursor_ = 0;
  std::size_t left_ = 0;
};

class EachRasterizerCarries : public testing::TestWithParam<RasterizerKind> {};
INSTANTIATE_TEST_SUITE_P(Rasterizers, EachRasterizerCarries,
                         testing::Values(RasterizerKind::points, RasterizerKind::compute),
                         [](const auto& param) { return std::string(name_of(param.param)); });

// Frame by frame, `next` giving the view of each.
template <class NextView>
void expect_both_carries_agree(const PointSet& points, RasterizerKind kind, const PointSize& point_size,
                               const NextView& next) {
  InOrder by_grid(points, Carry::grid);
  InOrder by_vertices(points, Carry::vertices);
  ProgressiveRenderer grid(by_grid, kind, points.grid, point_size);
  ProgressiveRenderer vertices(by_vertices, kind, points.grid, point_size);
  for (int frame = 0; frame < 12; ++frame) {
    const View view = next(frame);
    grid.draw(view, 2'000);
    vertices.draw(view, 2'000);
    const FrameData drawn = grid.read();
    ASSERT_GT(drawn.covered_pixels(), 100u) << frame;
    ASSERT_TRUE(same_picture(drawn, vertices.read())) << "frame " << frame;
  }
}

TEST_P(EachRasterizerCarries, GridAndVerticesAlikeForAStillCamera) {
  const View view = front_view(1.5, {161, 89});
  const PointSet points = random_points(30'000, 700, 1);
  for (const PointSize& point_size : {PointSize(1.0), PointSize(3.0), PointSize(1.0, 0.03)})
    expect_both_carries_agree(points, GetParam(), point_size, [&](int) { return view; });
}

TEST_P(EachRasterizerCarries, GridAndVerticesAlikeForAMovingCamera) {
  const Dataset& dataset = scene("city", 60'000);
  const View start = view_of(dataset, "oblique", {161, 89});
  for (const PointSize& point_size : {PointSize(1.0), PointSize(2.0), PointSize(1.0, 2.0)})
    expect_both_carries_agree(dataset.points, GetParam(), point_size, [&](int frame) {
      View view = start;
      view.eye += start.right * (1.7 * frame) + start.forward * (11.0 * frame);
      return view;
    });
}

TEST_P(EachRasterizerCarries, AHundredStillFramesKeepPositionColourIdAndDepth) {
  const PointSet points = random_points(20'000, 700, 2);
  for (const Carry carry : {Carry::grid, Carry::vertices}) {
    InOrder method(points, carry);
    ProgressiveRenderer renderer(method, GetParam(), points.grid);
    const View view = front_view(3.0, {160, 90});
    renderer.draw(view, 9'000);
    const FrameData before = renderer.read();
    ASSERT_GT(before.covered_pixels(), 1'000u);
    for (int frame = 0; frame < 100; ++frame) renderer.draw(view, 0);
    EXPECT_TRUE(same_picture(renderer.read(), before));
  }
}

TEST_P(EachRasterizerCarries, CountsAreThoseOfTheFramesThemselves) {
  const Dataset& dataset = scene("city", 60'000);
  const View start = view_of(dataset, "oblique", {161, 89});
  for (const Carry carry : {Carry::none, Carry::grid, Carry::vertices}) {
    InOrder method(dataset.points, carry);
    ProgressiveRenderer renderer(method, GetParam(), dataset.points.grid);
    std::size_t before = 0;
    for (int frame = 0; frame < 5; ++frame) {
      View view = start;
      view.eye += start.forward * (20.0 * (frame / 2));
      renderer.draw(view, 3'000);
      EXPECT_EQ(renderer.points_reprojected(), carry == Carry::none ? 0 : before) << frame;
      before = renderer.read().covered_pixels();
      EXPECT_EQ(renderer.covered_pixels(), before) << frame;
    }
  }
}

TEST_P(EachRasterizerCarries, NothingOfAnotherViewStaysWhenTheNextOneIsEmpty) {
  const Dataset& dataset = scene("city", 60'000);
  const View view = view_of(dataset, "oblique", {161, 89});
  View away = view;
  away.forward = -view.forward;
  away.right = -view.right;
  for (const Mode mode : all_modes()) {
    const auto method = make_method(mode, dataset.points, &*dataset.octree);
    ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid);
    renderer.draw(view, 10'000);
    ASSERT_GT(renderer.covered_pixels(), 100u);
    while (!renderer.draw(away, 1'000'000).converged) {
    }
    EXPECT_EQ(renderer.read().covered_pixels(), 0u) << name_of(mode);
    // and back
    while (!renderer.draw(view, 1'000'000).converged) {
    }
    EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, GetParam(), view))) << name_of(mode);
  }
}

TEST_P(EachRasterizerCarries, AConvergedStillViewReportsNothingDrawn) {
  const Dataset& dataset = scene("city", 60'000);
  const View view = view_of(dataset, "oblique", {161, 89});
  for (const Mode mode : all_modes()) {
    const auto method = make_method(mode, dataset.points, &*dataset.octree);
    ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid);
    while (!renderer.draw(view, 1'000'000).converged) {
    }
    const FrameReport again = renderer.draw(view, 1'000'000);
    EXPECT_TRUE(again.converged);
    EXPECT_EQ(again.points_filled, 0u) << name_of(mode);
  }
}

// Clouds that are there to break something.
PointSet awkward_cloud(int kind, std::mt19937& random) {
  const auto number = [&](int low, int high) { return std::uniform_int_distribution<int>(low, high)(random); };
  const int count = number(1, 600);
  std::vector<glm::ivec3> positions;
  const glm::ivec3 place(number(-500, 500), number(-500, 500), number(-500, 500));
  for (int i = 0; i < count; ++i) {
    const glm::ivec3 anywhere(number(-1'000, 1'000), number(-1'000, 1'000), number(-1'000, 1'000));
    switch (kind) {
      case 0:  // all in one place
        positions.push_back(place);
        break;
      case 1:  // on a plane across the line of sight of front_view: equal depths
        positions.push_back({anywhere.x, place.y, anywhere.z});
        break;
      case 2:  // anywhere
        positions.push_back(anywhere);
        break;
      case 3:  // clusters, mostly duplicates
        positions.push_back(glm::ivec3(number(0, 3), number(0, 3), number(0, 3)) * 400 + anywhere / 250);
        break;
      default:  // the ends of int32
        constexpr int kEnds[] = {std::numeric_limits<int>::min(), std::numeric_limits<int>::max()};
        positions.push_back({kEnds[number(0, 1)], number(0, 2) ? kEnds[number(0, 1)] : anywhere.y, anywhere.z * 99});
    }
  }
  return points_at(positions);
}

// As load_dataset does.
Dataset with_octree(PointSet set) {
  Dataset dataset;
  dataset.octree = std::make_shared<Octree>(build_octree(
      set.grid, set.bounds, PositionView(std::span<const PackedPoint>(set.points), &PackedPoint::position)));
  dataset.points = set;
  for (std::size_t i = 0; i < set.size(); ++i) dataset.points.points[i] = set.points[dataset.octree->order[i]];
  dataset.points.ids = dataset.octree->order;
  return dataset;
}

View awkward_view(const PointSet& set, std::mt19937& random) {
  std::uniform_real_distribution<double> part(-1.0, 1.0);
  const WorldBox box = world_box(set.grid, set.bounds);
  const glm::dvec3 reach = 0.5 * (box.max - box.min) + 0.01;
  const auto inside = [&] {
    return 0.5 * (box.min + box.max) + reach * glm::dvec3(part(random), part(random), part(random));
  };
  Camera camera;
  camera.target = inside();
  // In the cloud, before it, or exactly on a point
  switch (random() % 3) {
    case 0:
      camera.eye = inside();
      break;
    case 1:
      camera.eye = camera.target + (2.0 * part(random) + glm::dvec3(0, -2.5, 0)) * glm::length(reach);
      break;
    default:
      camera.eye = set.grid.world_from_grid(set.points[random() % set.size()].position);
  }
  constexpr double kFovs[] = {0.01, 1.0, 60.0, 120.0, 179.0};
  camera.fov_deg = kFovs[random() % std::size(kFovs)];
  constexpr double kNears[] = {0.001, 0.3, 2.0};
  const glm::ivec2 size(1 + static_cast<int>(random() % 70), 1 + static_cast<int>(random() % 50));
  return make_view(camera, size, kNears[random() % std::size(kNears)]);
}

TEST_P(EachRasterizerCarries, AwkwardCloudsAndViewsConvergeToBruteForce) {
  const auto start = std::chrono::steady_clock::now();
  std::mt19937 random(20'26);
  int rounds = 0;
  std::size_t covered = 0;
  for (; rounds < 80 && std::chrono::steady_clock::now() - start < std::chrono::seconds(20); ++rounds) {
    const int kind = rounds % 5;
    const Dataset dataset = with_octree(awkward_cloud(kind, random));
    const View first = awkward_view(dataset.points, random);
    View view = awkward_view(dataset.points, random);
    view.size = first.size;
    constexpr double kPointSizes[] = {1.0, 1.0, 2.0, 7.0};
    constexpr double kSplatSizes[] = {0.0, 0.0, 0.05, 1.0};
    const PointSize point_size(kPointSizes[random() % std::size(kPointSizes)],
                               kSplatSizes[random() % std::size(kSplatSizes)]);
    const auto budget = static_cast<std::uint32_t>(20 + random() % 400);
    if (random() % 3 == 0) view.eyes_apart = 0.01 * static_cast<double>(1 + random() % 200);
    std::vector<FrameData> expected;
    for (std::size_t eye = 0; eye < view.eyes(); ++eye)
      expected.push_back(brute_force_picture(dataset.points, GetParam(), view.of_eye(eye), point_size));
    covered += expected[0].covered_pixels();
    for (const Mode mode : {Mode::hierarchical, Mode::unstructured, Mode::hybrid}) {
      const auto method = make_method(mode, dataset.points, &*dataset.octree, {.seed = random()});
      ProgressiveRenderer renderer(*method, GetParam(), dataset.points.grid, point_size);
      // A few frames of another view first
      for (int frame = 0; frame < 2; ++frame) renderer.draw(first, budget);
      int frames = 0;
      while (!renderer.draw(view, budget).converged && ++frames < 1'000) {
      }
      for (std::size_t eye = 0; eye < view.eyes(); ++eye)
        ASSERT_TRUE(same_picture(renderer.read(eye), expected[eye]))
            << "round " << rounds << ", cloud " << kind << ", " << name_of(mode) << ", budget " << budget
            << ", point size " << point_size.pixels << ", splat size " << point_size.world << ", eye " << eye << " of "
            << view.eyes();
    }
  }
  EXPECT_GE(rounds, 20);
  EXPECT_GT(covered, 1'000u);
}

}  // namespace
}  // namespace stipple::test::render_carry
