#include "octree/read/laz/chunk_input.h"

#include <algorithm>
#include <cstring>
#include <span>

namespace stipple::laz {
namespace {

// A chunk of 50,000 points, as nearly all are, fits in one.
constexpr std::size_t kWindow = std::size_t{2} << 20;

}  // namespace

void ChunkInput::begin(const Chunk& chunk) {
  window_begin_ = chunk.begin;
  unread_ = chunk.bytes;
  fill(0);
}

const std::byte* ChunkInput::advance(const std::byte* place) {
  if (at_end()) return place;
  const auto used = static_cast<std::size_t>(place - window_.data());
  const std::size_t kept = limit_ + longest_ - used;
  std::memmove(window_.data(), place, kept);
  window_begin_ += used;
  fill(kept);
  return window_.data();
}

void ChunkInput::fill(std::size_t kept) {
  const std::size_t room = std::max(kWindow, 4 * longest_) - kept;
  const auto count = static_cast<std::size_t>(std::min<std::uint64_t>(room, unread_));
  window_.resize(kept + count + longest_);
  file_->read_at(window_begin_ + kept, std::span(window_).subspan(kept, count));
  unread_ -= count;
  std::memset(window_.data() + kept + count, 0, longest_);
  limit_ = at_end() ? kept + count : kept + count - longest_;
}

}  // namespace stipple::laz
