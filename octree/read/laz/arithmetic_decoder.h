// The arithmetic decoder: from bytes to symbols.
#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "octree/read/laz/symbol_model.h"

namespace stipple::laz {

// Plain state, so that a loop can keep a copy in registers. Functions read up to kReadAhead bytes beyond `at` and never
// check where the bytes end: whoever calls them bounds what a point can consume and looks at `at` between points.
//
// Any bytes at all decode to something. What no encoder writes sets `broken`; then all further values mean nothing.
struct ArithmeticDecoder {
  static constexpr std::size_t kReadAhead = 4;
  static constexpr std::size_t kStartBytes = 4;

  const std::byte* at = nullptr;
  std::uint32_t value = 0;   // place in the interval: below `length`
  std::uint32_t length = 0;  // of the interval; 2^24 or more between calls
  std::uint32_t broken = 0;

  // Reads the first kStartBytes bytes.
  void start(const std::byte* bytes) {
    value = big_endian(bytes);
    length = 0xFFFFFFFFu;
    broken = value == length;
    at = bytes + kStartBytes;
  }

  template <unsigned kCapacity>
  [[gnu::always_inline]] unsigned symbol(SymbolModel<kCapacity>& model) {
    const std::uint32_t unit = length >> kSymbolShift;
    const unsigned found = model.find(value / unit);
    const std::uint32_t low = model.bounds[found] * unit;
    const std::uint32_t next = model.bounds[found + 1] * unit;
    const std::uint32_t high = __builtin_expect_with_probability(found == model.last, 1, 0.5) ? length : next;
    value -= low;
    length = high - low;
    normalize();
    model.count(found);
    return found;
  }

  [[gnu::always_inline]] unsigned bit(BitModel& model) {
    const std::uint32_t low = model.zero_share * (length >> kBitShift);
    const bool one = value >= low;
    value -= one ? low : 0;
    length = one ? length - low : low;
    model.zeros += !one;
    normalize();
    if (--model.until_update == 0) [[unlikely]]
      model.update();
    return one;
  }

  // `count` bits that no model describes; 1 to 32, the low 16 first when there are more than 19.
  [[gnu::always_inline]] std::uint32_t bits(unsigned count) {
    if (count <= 19) return equal_shares(count);
    const std::uint32_t low = equal_shares(16);
    return equal_shares(count - 16) << 16 | low;
  }
  std::uint64_t bits64() {
    const std::uint64_t low = bits(32);
    return std::uint64_t{bits(32)} << 32 | low;
  }

 private:
  static std::uint32_t big_endian(const std::byte* bytes) {
    std::uint32_t word;
    std::memcpy(&word, bytes, sizeof word);
    return __builtin_bswap32(word);
  }

  [[gnu::always_inline]] std::uint32_t equal_shares(unsigned count) {
    length >>= count;
    const std::uint32_t share = value / length;
    value -= share * length;
    normalize();
    broken |= share >> count;
    return share;
  }

  // Takes in whole bytes until the interval is 2^24 or longer. It never is empty: a symbol's share is 2^9 at least.
  [[gnu::always_inline]] void normalize() {
    const unsigned shift = static_cast<unsigned>(__builtin_clz(length)) & 24u;
    const std::uint64_t next = std::uint64_t{value} << 32 | big_endian(at);
    value = static_cast<std::uint32_t>(next << shift >> 32);
    length <<= shift;
    at += shift / 8;
  }
};

}  // namespace stipple::laz
