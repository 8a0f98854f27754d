#include "render/method/steered_round.h"

#include <algorithm>
#include <utility>

namespace stipple {

SteeringState initial_state(const GpuSteering& steering) {
  const BudgetController::Limits& limits = steering.limits;
  SteeringState state;
  state.target_ms = steering.target_ms;
  state.least = limits.least;
  state.most = limits.most;
  state.budget = std::clamp(steering.first_budget, limits.least, limits.most);
  return state;
}

SteeredRound::SteeredRound(const GpuSteering& steering, std::size_t chunks)
    : program_(Program::compute("steer.glsl")),
      state_(sizeof(SteeringState)),
      stamps_(2 * sizeof(std::uint64_t)),
      commands_(chunks * sizeof(IndirectCommand)),
      copy_(sizeof(SteeringState)),
      told_(initial_state(steering)) {
  state_.write(0, &told_, sizeof told_);
}

void SteeredRound::restart(std::size_t slots) {
  slots_ = static_cast<std::uint32_t>(slots);
  ++round_;
}

void SteeredRound::begin_frame() {
  if (std::exchange(begun_, true)) return;
  timed_ = std::exchange(stamped_, false);
  if (timed_) {
    began_.write_to(stamps_, 0);
    ended_.write_to(stamps_, sizeof(std::uint64_t));
  }
  began_.take();
}

Selection SteeredRound::next(const GpuCloud& cloud, std::uint32_t most) {
  begin_frame();
  program_.use();
  state_.bind_storage(0);
  stamps_.bind_storage(1);
  commands_.bind_storage(2);
  glUniform1ui(0, slots_);
  glUniform1ui(1, most);
  glUniform1ui(2, round_);
  glUniform1i(3, std::exchange(timed_, false) ? 1 : 0);
  glUniform1ui(4, GpuCloud::kChunkPoints);
  glUniform1ui(5, kRasterGroupSize);
  glDispatchCompute(1, 1, 1);
  glMemoryBarrier(GL_SHADER_STORAGE_BARRIER_BIT | GL_COMMAND_BARRIER_BIT | GL_BUFFER_UPDATE_BARRIER_BIT);
  copy_.begin(state_);

  Selection selection;
  for (std::size_t first = 0; first < slots_; first += GpuCloud::kChunkPoints) {
    const auto number = static_cast<std::uint32_t>(selection.items.size());
    const GpuCloud::Chunk& chunk = cloud.chunks()[number];
    selection.items.push_back(SteeredRange{
        .points = &chunk.points,
        .ids = &chunk.ids,
        .commands = &commands_,
        .command = number,
        .size = static_cast<std::uint32_t>(std::min<std::size_t>(GpuCloud::kChunkPoints, slots_ - first))});
  }
  return selection;
}

void SteeredRound::end_frame() {
  if (!std::exchange(begun_, false)) return;
  ended_.take();
  stamped_ = true;
}

void SteeredRound::hear() {
  SteeringState state;
  if (copy_.arrived(&state)) learn(state);
}

void SteeredRound::await() {
  copy_.forget();
  SteeringState state;
  state_.read(0, &state, sizeof state);
  learn(state);
}

void SteeredRound::learn(const SteeringState& state) {
  points_ += state.total - told_.total;
  told_ = state;
}

std::uint64_t SteeredRound::take_points() {
  return std::exchange(points_, 0);
}

}  // namespace stipple
