// From rows, one record a point, to columns.
#pragma once

#include <cstddef>

namespace stipple {

// Copies `count` values of `size` bytes that stand `stride` apart at `in` to `out`, where they stand side by side.
void gather(std::size_t size, const std::byte* in, std::size_t stride, std::size_t count, std::byte* out);

// Turns the bytes of each of `count` scalars of 1, 2, 4 or 8 bytes around.
void swap_bytes(std::size_t size, std::byte* values, std::size_t count);

}  // namespace stipple
