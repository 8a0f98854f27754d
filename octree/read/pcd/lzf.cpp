#include "octree/read/pcd/lzf.h"

#include <cstring>

namespace stipple {
namespace {

constexpr std::size_t kLiterals = 32;
constexpr std::size_t kLongCopy = 7;

}  // namespace

LzfResult decode_lzf(std::span<const std::byte> in, std::span<std::byte> out) {
  LzfResult at;
  const auto next = [&] { return std::to_integer<std::size_t>(in[at.read++]); };
  while (at.read < in.size()) {
    const std::size_t control = std::to_integer<std::size_t>(in[at.read]);
    if (control < kLiterals) {
      const std::size_t length = control + 1;
      if (in.size() - at.read - 1 < length || out.size() - at.written < length) return at;
      std::memcpy(out.data() + at.written, in.data() + at.read + 1, length);
      at.read += 1 + length;
      at.written += length;
      continue;
    }
    std::size_t length = control >> 5;
    const std::size_t bytes = length == kLongCopy ? 3 : 2;
    if (in.size() - at.read < bytes) return at;
    const std::size_t begin = at.read;
    ++at.read;
    if (length == kLongCopy) length += next();
    const std::size_t distance = ((control & 31u) << 8 | next()) + 1;
    length += 2;
    if (distance > at.written || out.size() - at.written < length) {
      at.read = begin;
      return at;
    }
    // Byte by byte where the copy reaches into itself: it repeats what it has just written
    std::byte* const to = out.data() + at.written;
    const std::byte* const from = to - distance;
    if (distance >= length)
      std::memcpy(to, from, length);
    else
      for (std::size_t i = 0; i < length; ++i) to[i] = from[i];
    at.written += length;
  }
  at.good = at.written == out.size();
  return at;
}

}  // namespace stipple
