// Clouds that are drawn while their points arrive.
#include "render/method/arriving.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <thread>

#include "octree/core/error.h"
#include "render/method/while_loading.h"
#include "render/store/background_load.h"
#include "render/store/growing_cloud.h"
#include "render/store/replayed_arrivals.h"
#include "src/scene/scene.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_arriving {
namespace {

constexpr std::uint64_t kPoints = 60'000;

// The methods of the papers, and what hybrid begins with.
struct Kind {
  const char* name;
  ArrivalOrder order;
  Carry carry;
  std::optional<GpuSteering> steering{};
};
constexpr Kind kKinds[] = {
    {"S19", ArrivalOrder::permuted, Carry::vertices},
    {"S18", ArrivalOrder::displaced, Carry::indices},
    {"hybrid", ArrivalOrder::displaced, Carry::vertices},
    {"S19_steered", ArrivalOrder::permuted, Carry::vertices, GpuSteering{.target_ms = 1.0, .limits = {.least = 4'000}}},
    {"S18_steered", ArrivalOrder::displaced, Carry::indices,
     GpuSteering{.target_ms = 1.0, .limits = {.least = 4'000}}}};

std::vector<std::uint32_t> read_ids(const GrowingCloud& cloud) {
  std::vector<std::uint32_t> ids;
  for (const GpuCloud::Chunk& chunk : cloud.cloud().chunks()) {
    std::vector<std::uint32_t> part(chunk.ids.bytes() / sizeof(std::uint32_t));
    chunk.ids.read(0, part.data(), chunk.ids.bytes());
    ids.insert(ids.end(), part.begin(), part.end());
  }
  ids.resize(cloud.slots());
  return ids;
}

PackedPoint numbered_point(std::uint32_t id) {
  return {glm::ivec3(static_cast<int>(id), 7, -static_cast<int>(id)), id * 2654435761u};
}

std::vector<PackedPoint> numbered(std::uint32_t first, std::uint32_t count) {
  std::vector<PackedPoint> points(count);
  for (std::uint32_t i = 0; i < count; ++i) points[i] = numbered_point(first + i);
  return points;
}

void expect_points_and_slots(const GrowingCloud& cloud, std::uint32_t points) {
  const std::vector<std::uint32_t> ids = read_ids(cloud);
  std::vector<std::uint32_t> slot_of(cloud.cloud().size());
  cloud.slot_of().read(0, slot_of.data(), cloud.slot_of().bytes());
  std::vector<PackedPoint> at;
  for (const GpuCloud::Chunk& chunk : cloud.cloud().chunks()) {
    std::vector<PackedPoint> part(chunk.points.bytes() / sizeof(PackedPoint));
    chunk.points.read(0, part.data(), chunk.points.bytes());
    at.insert(at.end(), part.begin(), part.end());
  }
  ASSERT_EQ(ids.size(), points);
  std::vector<bool> seen(cloud.cloud().size());
  std::size_t wrong = 0;
  for (std::uint32_t slot = 0; slot < points; ++slot) {
    const std::uint32_t id = ids[slot];
    ASSERT_LT(id, seen.size());
    wrong += seen[id] || slot_of[id] != slot || at[slot].position != numbered_point(id).position ||
             at[slot].rgba != numbered_point(id).rgba;
    seen[id] = true;
  }
  EXPECT_EQ(wrong, 0u);
}

TEST(GrowingCloud, DisplacedPointsStandOnceEachWithoutAGap) {
  constexpr std::uint32_t kTotal = 200'000;
  GrowingCloud cloud(kTotal, ArrivalOrder::displaced, 5, true);
  std::uint32_t there = 0;
  for (const std::uint32_t batch : {1u, 2u, 127u, 50'000u, 70'000u, 79'870u}) {
    cloud.add(numbered(there, batch), there);
    there += batch;
    expect_points_and_slots(cloud, there);
  }
  EXPECT_TRUE(cloud.complete());
  EXPECT_GE(cloud.bytes_uploaded(), kTotal * std::uint64_t{24});
}

TEST(GrowingCloud, DisplacedPointsCrossChunks) {
  constexpr std::uint32_t kTotal = GpuCloud::kChunkPoints + 100'000;
  GrowingCloud cloud(kTotal, ArrivalOrder::displaced, 1, true);
  for (std::uint32_t first = 0; first < kTotal; first += 1'000'000)
    cloud.add(numbered(first, std::min(1'000'000u, kTotal - first)), first);
  expect_points_and_slots(cloud, kTotal);
}

TEST(GrowingCloud, PermutedPointsEndWhereTheShuffleOfAllHasThem) {
  constexpr std::uint32_t kTotal = 50'000;
  GrowingCloud cloud(kTotal, ArrivalOrder::permuted, 9, false);
  EXPECT_EQ(cloud.slots(), 0u);
  // Any order of batches; in free slots a point that is there
  cloud.add(numbered(30'000, 20'000), 30'000);
  EXPECT_EQ(cloud.slots(), kTotal);
  for (const std::uint32_t id : read_ids(cloud)) ASSERT_GE(id, 30'000u);
  EXPECT_FALSE(cloud.complete());
  cloud.add(numbered(0, 30'000), 0);
  EXPECT_TRUE(cloud.complete());
  const std::vector<std::uint32_t> ids = read_ids(cloud);
  for (std::uint32_t id = 0; id < kTotal; ++id) ASSERT_EQ(ids[shuffled_slot(id, kTotal, 9)], id);
}

class EachArrival : public testing::TestWithParam<std::tuple<int, RasterizerKind>> {
 protected:
  const Kind& kind() const { return kKinds[std::get<0>(GetParam())]; }
  RasterizerKind rasterizer() const { return std::get<1>(GetParam()); }
};
INSTANTIATE_TEST_SUITE_P(Kinds, EachArrival,
                         testing::Combine(testing::Range(0, 5),
                                          testing::Values(RasterizerKind::points, RasterizerKind::compute)),
                         [](const auto& param) {
                           return std::string(kKinds[std::get<0>(param.param)].name) + "_" +
                                  std::string(name_of(std::get<1>(param.param)));
                         });

// The scene's points in the order of their ids, as a file has them.
PointSet in_file_order(const Dataset& dataset) {
  PointSet set = dataset.points;
  for (std::size_t i = 0; i < set.size(); ++i) set.points[dataset.points.ids[i]] = dataset.points.points[i];
  set.ids.clear();
  return set;
}

TEST_P(EachArrival, ConvergesToBruteForceWhileTheCameraMoves) {
  const Dataset& dataset = scene("city", kPoints);
  const PointSet points = in_file_order(dataset);
  View view = view_of(dataset, "oblique");
  const glm::dvec3 step = view.right * 3.0 + view.forward * 2.0;
  Arriving arriving(points.size(), kind().order, 3, kind().carry, kind().steering);
  ProgressiveRenderer renderer(arriving, rasterizer(), points.grid);
  renderer.warm_up(view.size);
  EXPECT_FALSE(renderer.draw(view, 5'000).converged);
  // Batches of 7,000 points, from the last to the first
  for (std::uint32_t end = kPoints; end > 0; end -= std::min(end, 7'000u)) {
    const std::uint32_t first = end - std::min(end, 7'000u);
    arriving.add(std::span(points.points).subspan(first, end - first), first);
    view.eye += step;
    EXPECT_FALSE(renderer.draw(view, 5'000).converged);
    EXPECT_GT(renderer.covered_pixels(), 100u) << first;
  }
  while (!renderer.draw(view, 9'000).converged) {
  }
  EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(points, rasterizer(), view)));
}

TEST_P(EachArrival, NothingThatWasSeenIsLostToAnArrival) {
  const Dataset& dataset = scene("city", kPoints);
  const PointSet points = in_file_order(dataset);
  const View view = view_of(dataset, "oblique");
  Arriving arriving(points.size(), kind().order, 3, kind().carry, kind().steering);
  ProgressiveRenderer renderer(arriving, rasterizer(), points.grid);
  arriving.add(std::span(points.points).first(30'000), 0);
  for (int frame = 0; frame < 3; ++frame) renderer.draw(view, 10'000);
  const FrameData before = renderer.read();
  ASSERT_GT(before.covered_pixels(), 1'000u);
  arriving.add(std::span(points.points).subspan(30'000), 30'000);
  renderer.draw(view, 0);
  EXPECT_TRUE(same_picture(renderer.read(), before));
}

TEST_P(EachArrival, AnEmptyCloudConverges) {
  Arriving arriving(0, kind().order, 3, kind().carry, kind().steering);
  ProgressiveRenderer renderer(arriving, rasterizer(), points_at({}).grid);
  EXPECT_TRUE(renderer.draw(front_view(2.0), 10).converged);
}

TEST(ColorUpload, PaintsEveryMethodAndItsPicture) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  PointSet painted = dataset.points;
  for (std::size_t i = 0; i < painted.size(); ++i) painted.points[i].rgba = 0xFF000000u | painted.id(i);
  for (const RasterizerKind kind : {RasterizerKind::points, RasterizerKind::compute}) {
    const FrameData expected = brute_force_picture(painted, kind, view);
    for (const Mode mode : all_modes()) {
      const auto method = make_method(mode, dataset.points, &*dataset.octree);
      ProgressiveRenderer renderer(*method, kind, dataset.points.grid);
      // In the middle, so that some points are in the picture and others come; lod stops at its budget
      const std::uint32_t budget = mode == Mode::lod ? kPoints : 10'000;
      for (int frame = 0; frame < 3; ++frame) renderer.draw(view, budget);
      const Buffer<std::uint32_t> by_id = colors_by_id(painted);
      const ColorUpload colors(by_id);
      EXPECT_EQ(colors.bytes(), 4 * kPoints);
      EXPECT_TRUE(method->recolor(colors, painted)) << name_of(mode);
      renderer.recolor(colors);
      while (!renderer.draw(view, budget).converged) {
      }
      EXPECT_TRUE(same_picture(renderer.read(), expected)) << name_of(mode);
    }
  }
}

// Takes the picture's points away and brings others back, as a change of hidden classes does.
TEST(ColorUpload, HidesAndShowsPointsOfEveryMethodAndItsPicture) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  for (const double point_size : {1.0, 3.0}) {
    for (const Mode mode : all_modes()) {
      const auto method = make_method(mode, dataset.points, &*dataset.octree);
      ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid, point_size);
      for (int frame = 0; frame < 3; ++frame) renderer.draw(view, 10'000);
      std::vector<PointSet> hidden(2, dataset.points);
      for (const std::uint32_t third : {0u, 1u}) {
        PointSet& points = hidden[third];
        for (std::size_t i = 0; i < points.size(); ++i)
          if (points.id(i) % 3 == third) points.points[i].rgba &= 0x00FFFFFFu;
        const ColorUpload colors(colors_by_id(points));
        method->recolor(colors, points);
        renderer.recolor(colors);
        renderer.use(*method);
        while (!renderer.draw(view, mode == Mode::lod ? kPoints : 20'000).converged) {
        }
        EXPECT_TRUE(
            same_picture(renderer.read(), brute_force_picture(points, RasterizerKind::compute, view, point_size)))
            << name_of(mode) << ", points of " << point_size;
      }
    }
  }
}

TEST(ColorUpload, RefusesPointsThatAreNotNumberedFromZero) {
  PointSet points = points_at({{0, 0, 0}, {1, 0, 0}});
  points.ids = {5, 6};
  EXPECT_THROW(colors_by_id(points), Error);
}

// A source whose batches come when the test says, and which may break off.
class SlowSource final : public PointSource {
 public:
  SlowSource(const PointSource& source, std::size_t fails_after) : source_(source), fails_after_(fails_after) {}
  const SourceInfo& info() const override { return source_.info(); }
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override {
    std::atomic<std::size_t> batches{0};
    source_.read(attributes, [&](const PointBatch& batch) {
      if (batches++ == fails_after_) throw Error("the disk is gone");
      consume(batch);
    });
  }

 private:
  const PointSource& source_;
  std::size_t fails_after_;
};

FrameData drawn_while_loading(PointArrivals& arrivals, BackgroundLoad* load, Mode mode, bool by_index,
                              RasterizerKind kind, const Grid& grid, const View& view, WhileLoading** seen = nullptr) {
  static std::unique_ptr<WhileLoading> loading;
  loading = std::make_unique<WhileLoading>(
      arrivals, mode,
      WhileLoading::Options{
          .method = {.carry_indices = by_index}, .most_arrivals = 17'001, .cut_at_once = load == nullptr});
  if (seen) *seen = loading.get();
  ProgressiveRenderer renderer(loading->method(), kind, grid);
  if (load) load->start();
  for (int frame = 0; frame < 100'000; ++frame) {
    if (load && loading->idle()) load->wait();
    loading->advance(renderer);
    const FrameReport report = renderer.draw(view, 9'000);
    const bool by_clusters = mode != Mode::hybrid || loading->by_clusters();
    if (report.converged && loading->whole() && by_clusters) return renderer.read();
    // The clusters are not cut yet, and there is nothing to draw
    if (report.converged) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }
  ADD_FAILURE() << "does not converge";
  return renderer.read();
}

TEST(WhileLoading, EndsLikeBruteForceByEveryMethod) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  for (const RasterizerKind kind : {RasterizerKind::points, RasterizerKind::compute}) {
    const FrameData expected = brute_force_picture(dataset.points, kind, view);
    for (const auto& [mode, by_index] :
         {std::pair{Mode::unstructured, false}, {Mode::unstructured, true}, {Mode::hybrid, false}}) {
      ReplayedArrivals arrivals(dataset);
      WhileLoading* loading = nullptr;
      EXPECT_TRUE(same_picture(
          drawn_while_loading(arrivals, nullptr, mode, by_index, kind, dataset.points.grid, view, &loading), expected))
          << name_of(mode) << " " << by_index;
      EXPECT_EQ(loading->points_loaded(), kPoints);
      EXPECT_EQ(loading->color_bytes_uploaded(), 0u);
    }
  }
}

TEST(WhileLoading, ColoursEndAsThoseOfTheWholeCloud) {
  const auto source = make_scene("terrain", 200'000, 1);
  const Dataset whole = load_dataset(*source, "height", {});
  const View view = view_of(whole, "oblique");
  for (const Mode mode : {Mode::unstructured, Mode::hybrid}) {
    BackgroundLoad load(*source, "height");
    WhileLoading* loading = nullptr;
    const FrameData drawn =
        drawn_while_loading(load, &load, mode, false, RasterizerKind::compute, whole.points.grid, view, &loading);
    EXPECT_TRUE(same_picture(drawn, brute_force_picture(whole.points, RasterizerKind::compute, view)));
    EXPECT_EQ(hash_points(loading->whole()->points), hash_points(whole.points));
    // The first batch is a part of the terrain: its heights are not those of all
    EXPECT_EQ(loading->color_bytes_uploaded(), 4 * 200'000u);
  }
}

TEST(WhileLoading, WhatReadingThrowsArrives) {
  const auto source = make_scene("city", 300'000, 1);
  const SlowSource broken(*source, 1);
  BackgroundLoad load(broken, "rgb");
  EXPECT_THROW(drawn_while_loading(load, &load, Mode::unstructured, false, RasterizerKind::compute, source->info().grid,
                                   front_view(10.0)),
               Error);
}

TEST(WhileLoading, CanBeGivenUp) {
  const auto source = make_scene("city", 500'000, 1);
  BackgroundLoad load(*source, "rgb");
  load.pause();
  load.start();
}

TEST(WhileLoading, SaysWhatMemoryItTakes) {
  const Dataset& dataset = scene("city", kPoints);
  ReplayedArrivals arrivals(dataset);
  for (const Mode mode : {Mode::unstructured, Mode::hybrid})
    EXPECT_THROW(WhileLoading(arrivals, mode, {.method = {.limits = {.gpu = 1'000'000}}}), Error);
}

}  // namespace
}  // namespace stipple::test::render_arriving
