// What the readers of trees on disk have in common.
#pragma once

#include <chrono>
#include <cstddef>

namespace stipple {

// Reads wait for the disk, not for a core.
inline constexpr std::size_t kReadThreads = 4;
// How long to wait for a read when there is nothing else to do: a picture that stands still for a frame is better than
// a busy one.
inline constexpr std::chrono::milliseconds kReadPatience{20};

}  // namespace stipple
