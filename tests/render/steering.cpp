// Mode unstructured where the GPU steers the points a frame (S19).
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <tuple>

#include "render/method/progressive_renderer.h"
#include "render/method/steered_round.h"
#include "src/run/view_run.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_steering {
namespace {

// The pass by itself, with time stamps of our own.
class Pass {
 public:
  Pass(const GpuSteering& steering, std::uint32_t chunk_slots, std::size_t chunks)
      : chunk_slots_(chunk_slots),
        program_(Program::compute("steer.glsl")),
        state_(sizeof(SteeringState)),
        stamps_(2 * sizeof(std::uint64_t)),
        commands_(chunks * sizeof(IndirectCommand)) {
    const SteeringState initial = initial_state(steering);
    state_.write(0, &initial, sizeof initial);
  }

  // A frame of the round with this number. The last one began and ended then, in nanoseconds; of none: it is the first.
  SteeringState run(std::uint32_t slots, std::uint32_t most, std::uint32_t round,
                    const std::optional<std::array<std::uint64_t, 2>>& last = {}) {
    if (last) stamps_.write(0, last->data(), sizeof *last);
    program_.use();
    state_.bind_storage(0);
    stamps_.bind_storage(1);
    commands_.bind_storage(2);
    glUniform1ui(0, slots);
    glUniform1ui(1, most);
    glUniform1ui(2, round);
    glUniform1i(3, last ? 1 : 0);
    glUniform1ui(4, chunk_slots_);
    glUniform1ui(5, kRasterGroupSize);
    glDispatchCompute(1, 1, 1);
    glMemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
    SteeringState state;
    state_.read(0, &state, sizeof state);
    return state;
  }
  // The slots that the commands draw.
  std::vector<std::uint32_t> drawn(std::uint32_t slots) const {
    std::vector<IndirectCommand> commands(commands_.bytes() / sizeof(IndirectCommand));
    commands_.read(0, commands.data(), commands_.bytes());
    std::vector<std::uint32_t> drawn;
    for (std::uint32_t c = 0; c * chunk_slots_ < slots; ++c) {
      const IndirectCommand& command = commands[c];
      const std::uint32_t size = std::min(chunk_slots_, slots - c * chunk_slots_);
      EXPECT_LE(command.count, size);
      EXPECT_LT(command.begin, size);
      EXPECT_EQ(command.instance_count, 1u);
      EXPECT_EQ(command.first, 0u);
      EXPECT_EQ(command.groups_x * command.groups_y, (command.count + kRasterGroupSize - 1) / kRasterGroupSize);
      EXPECT_EQ(command.groups_z, 1u);
      for (std::uint32_t i = 0; i < command.count; ++i) drawn.push_back(c * chunk_slots_ + (command.begin + i) % size);
    }
    return drawn;
  }

 private:
  std::uint32_t chunk_slots_;
  Program program_;
  GpuBuffer state_;
  GpuBuffer stamps_;
  GpuBuffer commands_;
};

TEST(Steering, TheGpuEstimatesAsTheControllerDoes) {
  constexpr std::uint32_t kSlots = 0xFFFFFFF0u;
  std::mt19937_64 random(1);
  for (const double per_million : {4.0, 40.0, 900.0}) {
    const GpuSteering steering{
        .target_ms = 33.0, .first_budget = 50'000, .limits = {.least = 2'000, .most = 3'000'000}};
    Pass pass(steering, 1u << 28, 16);
    BudgetController controller(steering.target_ms, steering.first_budget, steering.limits);
    SteeringState state = pass.run(kSlots, kSlots, 1);
    EXPECT_EQ(state.budget, 50'000u);
    for (std::uint32_t frame = 2; frame < 80; ++frame) {
      // Costs that double in between, noise, and frames of fewer points than the budget
      const double noise = std::uniform_real_distribution<double>(0.8, 1.25)(random);
      const double ms = (frame < 40 ? 1.0 : 2.0) * noise * (5.0 + per_million * 1e-6 * state.drawn);
      const std::uint64_t began = random() >> 2;
      const auto nanoseconds = static_cast<std::uint64_t>(ms * 1e6);
      controller.frame_done(state.drawn, static_cast<double>(nanoseconds) * 1e-6);
      const std::uint32_t most = frame % 10 == 0 ? 7'000 : kSlots;
      state = pass.run(kSlots, most, frame, std::array{began, began + nanoseconds});
      ASSERT_NEAR(state.budget, controller.budget(), 1.0) << frame << ", " << per_million << " ms a million";
      ASSERT_EQ(state.drawn, std::min(state.budget, most));
    }
  }
}

TEST(Steering, ARoundDrawsEachSlotOnceAroundTheEnd) {
  std::mt19937 random(2);
  for (const std::uint32_t slots : {1u, 7u, 1'000u, 1'024u, 1'500u, 40'000u})
    for (const std::uint32_t chunk_slots : {1u << 8, 1u << 10, 1u << 20}) {
      Pass pass({.target_ms = 10.0, .first_budget = 1u << 20}, chunk_slots, slots / chunk_slots + 1);
      std::uint32_t cursor = 0;
      for (std::uint32_t round = 1; round < 4; ++round) {
        std::vector<int> times(slots);
        std::uint32_t left = slots;
        for (int frame = 0; left > 0; ++frame) {
          // The last round is given up halfway
          const std::uint32_t most = frame == 0 ? slots / 3 : 1 + static_cast<std::uint32_t>(random() % slots);
          const SteeringState state = pass.run(slots, most, round);
          const std::vector<std::uint32_t> drawn = pass.drawn(slots);
          ASSERT_EQ(drawn.size(), std::min(most, left));
          for (const std::uint32_t slot : drawn) {
            ++times[slot];
            ASSERT_LT((slot + slots - cursor) % slots, drawn.size()) << "from the end of the last stretch on";
          }
          left -= static_cast<std::uint32_t>(drawn.size());
          cursor = (cursor + static_cast<std::uint32_t>(drawn.size())) % slots;
          ASSERT_EQ(state.left, left);
          ASSERT_EQ(state.cursor, cursor);
          if (round == 2 && frame == 1) break;
        }
        if (left == 0) {
          EXPECT_EQ(std::ranges::count(times, 1), slots);
        }
      }
    }
}

constexpr std::uint32_t kPoints = 60'000;
// No frame draws a scene of kPoints at once.
const GpuSteering kSmallSteps{.target_ms = 5.0, .first_budget = 4'000, .limits = {.least = 3'000, .most = 9'000}};

class EachSteered : public testing::TestWithParam<std::tuple<Carry, RasterizerKind>> {
 protected:
  RasterizerKind rasterizer() const { return std::get<1>(GetParam()); }
  std::unique_ptr<Method> method(const PointSet& points, const GpuSteering& steering = kSmallSteps) const {
    return make_method(Mode::unstructured, points, nullptr,
                       {.seed = 3, .carry_indices = std::get<0>(GetParam()) == Carry::indices, .steering = steering});
  }
  // The picture of a view, drawn to its end; every frame is looked at.
  std::uint64_t converge(ProgressiveRenderer& renderer, const View& view) const {
    std::uint64_t filled = 0;
    for (int frame = 0; frame < 10'000; ++frame) {
      renderer.draw(view, 100'000);
      const FrameReport report = renderer.await_report();
      EXPECT_LE(report.points_filled, report.budget);
      EXPECT_GE(report.budget, kSmallSteps.limits.least);
      EXPECT_LE(report.budget, kSmallSteps.limits.most);
      filled += report.points_filled;
      EXPECT_EQ(report.converged, filled == kPoints);
      if (report.converged) return filled;
    }
    ADD_FAILURE() << "does not converge";
    return filled;
  }
};
INSTANTIATE_TEST_SUITE_P(Carries, EachSteered,
                         testing::Combine(testing::Values(Carry::vertices, Carry::indices),
                                          testing::Values(RasterizerKind::points, RasterizerKind::compute)),
                         [](const auto& param) {
                           const bool vertices = std::get<0>(param.param) == Carry::vertices;
                           return std::string(vertices ? "vertices_" : "indices_") +
                                  std::string(name_of(std::get<1>(param.param)));
                         });

TEST_P(EachSteered, IsFinishedWhenAllIsDrawnAndNotBefore) {
  const Dataset& dataset = scene("city", kPoints);
  const auto drawn = method(dataset.points);
  ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid);
  // The second view begins where the first has ended, the third in the middle of the cloud
  for (const char* camera : {"oblique", "low"}) {
    const View view = view_of(dataset, camera);
    converge(renderer, view);
    EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, rasterizer(), view))) << camera;
    renderer.draw(view_of(dataset, "aerial"), 100'000);
    EXPECT_FALSE(renderer.await_report().converged);
  }
}

TEST_P(EachSteered, ConvergesWithoutBeingWaitedFor) {
  const Dataset& dataset = scene("terrain", kPoints);
  const View view = view_of(dataset, "oblique");
  const auto drawn = method(dataset.points);
  ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid);
  renderer.warm_up(view.size);
  std::uint64_t filled = 0;
  int frames = 0;
  for (FrameReport report; !report.converged && frames < 100'000; ++frames) {
    report = renderer.draw(view, 100'000);
    filled += report.points_filled;
  }
  EXPECT_EQ(filled, kPoints);
  EXPECT_GT(frames, 6);
  EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(dataset.points, rasterizer(), view)));
}

TEST_P(EachSteered, ConvergesForTwoEyesAndSplatsAfterTheCameraMoved) {
  const Dataset& dataset = scene("forest", kPoints);
  const PointSize splats(1.0, 0.6);
  const auto drawn = method(dataset.points);
  ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid, splats);
  View view = view_of(dataset, "low", {160, 90});
  view.eyes_apart = 0.5;
  for (int frame = 0; frame < 4; ++frame) {
    View other = view;
    other.eye += view.forward * (20.0 - 5.0 * frame);
    renderer.draw(other, 100'000);
  }
  renderer.await_report();
  EXPECT_EQ(converge(renderer, view), kPoints);
  for (const std::size_t eye : {0u, 1u})
    EXPECT_TRUE(
        same_picture(renderer.read(eye), brute_force_picture(dataset.points, rasterizer(), view.of_eye(eye), splats)));
}

TEST_P(EachSteered, DrawsNoMoreThanIsAskedFor) {
  const Dataset& dataset = scene("city", kPoints);
  const View view = view_of(dataset, "oblique");
  const auto drawn = method(dataset.points);
  ProgressiveRenderer renderer(*drawn, rasterizer(), dataset.points.grid);
  for (const std::uint32_t most : {77u, 0u, 1u}) {
    renderer.draw(view, most);
    EXPECT_EQ(renderer.await_report().points_filled, most);
  }
}

TEST_P(EachSteered, AnEmptyCloudConverges) {
  const PointSet nothing = points_at({});
  const auto drawn = method(nothing);
  ProgressiveRenderer renderer(*drawn, rasterizer(), nothing.grid);
  renderer.warm_up({64, 36});
  EXPECT_TRUE(renderer.draw(front_view(2.0, {64, 36}), 1'000).converged);
  EXPECT_TRUE(renderer.await_report().converged);
}

TEST(Steering, ConvergesAcrossChunks) {
  const PointSet points = random_points(GpuCloud::kChunkPoints + 100'000, 1'500, 5);
  const View view = front_view(2.0, {64, 36});
  const auto method = make_method(Mode::unstructured, points, nullptr,
                                  {.steering = GpuSteering{.target_ms = 1e9, .first_budget = 1'700'000}});
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, points.grid);
  // Not from the beginning
  View other = view;
  other.eye.x += 0.1;
  renderer.draw(other, 3'000'000);
  std::uint64_t filled = 0;
  for (FrameReport report = renderer.await_report(); !report.converged; report = renderer.await_report()) {
    renderer.draw(view, 3'000'000);
    filled += renderer.await_report().points_filled;
  }
  EXPECT_EQ(filled, points.size());
  EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(points, RasterizerKind::compute, view)));
}

TEST(Steering, ARunKnowsThePointsOfEachFrame) {
  const Dataset& dataset = scene("city", kPoints);
  const auto method = make_method(Mode::unstructured, dataset.points, nullptr, {.steering = kSmallSteps});
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid);
  std::uint64_t before = 0;
  const FrameState end =
      run_view(renderer, view_of(dataset, "oblique"), {.points = 1, .frames_per_second = 200.0}, {},
               [&](const FrameState& state) {
                 EXPECT_EQ(state.points_drawn - before, std::min<std::uint64_t>(state.budget, kPoints - before));
                 before = state.points_drawn;
               });
  EXPECT_TRUE(end.converged);
  EXPECT_EQ(end.points_drawn, kPoints);
}

// Mesa's software renderer: too slow for the first, quick enough for the second.
TEST(Steering, TheBudgetFollowsTheClockToItsLimits) {
  const Dataset& dataset = scene("city", kPoints);
  for (const auto& [target_ms, limit] : {std::pair{1e-6, 3'000u}, {1e6, 9'000u}}) {
    GpuSteering steering = kSmallSteps;
    steering.target_ms = target_ms;
    const auto method = make_method(Mode::unstructured, dataset.points, nullptr, {.steering = steering});
    ProgressiveRenderer renderer(*method, RasterizerKind::compute, dataset.points.grid);
    for (int frame = 0; frame < 8; ++frame) renderer.draw(view_of(dataset, "oblique"), 100'000);
    EXPECT_EQ(renderer.await_report().budget, limit);
  }
}

}  // namespace
}  // namespace stipple::test::render_steering
