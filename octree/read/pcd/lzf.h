// LZF, as binary_compressed PCD files have it.
// Format: M. Lehmann's LibLZF. A control byte below 32 is followed by that many literal bytes and one more; any other
// begins a copy of 2 plus its upper three bits bytes (7: plus the next byte), from 1 plus a distance of 13 bits back:
// its lower five bits, then the byte that follows.
#pragma once

#include <cstddef>
#include <span>

namespace stipple {

// No bytes of LZF hold more than this many times as many: 3 bytes for a copy of 264.
inline constexpr std::size_t kMostLzfGrowth = 88;

struct LzfResult {
  bool good = false;
  std::size_t read = 0;     // bytes of `in` that were used; where the fault is when not good
  std::size_t written = 0;  // bytes of `out` that were filled
};

// Good when all of `in` gives exactly as many bytes as `out` has. Never reads or writes beyond either.
LzfResult decode_lzf(std::span<const std::byte> in, std::span<std::byte> out);

}  // namespace stipple
