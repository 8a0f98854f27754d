#include "src/study/frame_keeper.h"

#include <fmt/format.h>

namespace stipple {

namespace fs = std::filesystem;

FrameKeeper::FrameKeeper(const fs::path& root, fs::path folder, std::string provenance, std::uint64_t every)
    : root_(root), folder_(std::move(folder)), provenance_(std::move(provenance)), every_(every) {
  fs::remove_all(root_ / folder_);
  fs::create_directories(root_ / folder_);
}

void FrameKeeper::offer(const FrameState& state, const Image& image) {
  if ((every_ ? state.frame - 1 : state.points_drawn) >= next_) keep(state, image);
}

void FrameKeeper::keep(const FrameState& state, const Image& image) {
  next_ = every_ ? state.frame - 1 + every_ : 2 * state.points_drawn;
  if (!kept_.empty() && kept_.back().frame == state.frame) return;
  const fs::path file = folder_ / fmt::format("{:05}.png", state.frame);
  write_png(root_ / file, image,
            {{"stipple", provenance_},
             {"frame", std::to_string(state.frame)},
             {"points_drawn", std::to_string(state.points_drawn)}});
  kept_.push_back({state.frame, file.string()});
}

}  // namespace stipple
