// Adaptive models: how likely each symbol is, learned from the symbols seen so far.
//
// The model is that of LASzip, so every rounding below is part of the file format. Source: A. Said, "Introduction to
// Arithmetic Coding", 2004, and "FastAC"; parameters from the LASzip specification, "Arithmetic coder".
//
// What is ours is the search: no table that narrows down a bisection, but the 16-bit lower bounds of the symbols
// compared eight at a time, in one or two steps without a branch. A symbol that is hard to predict costs a comparison
// instead of a mispredicted jump, and rebuilding a model writes no table.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace stipple::laz {

inline constexpr unsigned kSymbolShift = 15;  // bounds are in units of 2^-15 of the interval
inline constexpr unsigned kBitShift = 13;     // likewise of a model of one bit

// What stands at a bound that is none: above every place in an interval, which may exceed 2^15 by 63.
inline constexpr std::uint16_t kNoBound = 0xFFFF;

// How many of kCount ascending `bounds` are at most `place`. kCount is a multiple of 8, at most 40.
template <unsigned kCount>
[[gnu::always_inline]] inline unsigned count_at_most(const std::uint16_t* bounds, std::uint32_t place) {
  static_assert(kCount % 8 == 0 && kCount <= 40);
#if defined(__SSE2__)
  const __m128i wanted = _mm_set1_epi16(static_cast<std::int16_t>(place));
  const auto at_most = [&](unsigned first) {
    const __m128i eight = _mm_load_si128(reinterpret_cast<const __m128i*>(bounds + first));
    return _mm_cmpeq_epi16(_mm_subs_epu16(eight, wanted), _mm_setzero_si128());
  };
  std::uint64_t mask = 0;
  for (unsigned first = 0; first < kCount; first += 16) {
    const __m128i low = at_most(first);
    const __m128i high = first + 8 < kCount ? at_most(first + 8) : _mm_setzero_si128();
    mask |= static_cast<std::uint64_t>(_mm_movemask_epi8(_mm_packs_epi16(low, high))) << first;
  }
  // The bounds ascend, so the ones stand below the zeros, of which there are some: std::countr_one() would ask
  return static_cast<unsigned>(__builtin_ctzll(~mask));
#else
  unsigned count = 0;
  for (unsigned i = 0; i < kCount; ++i) count += bounds[i] <= place;
  return count;
#endif
}

// The counters of a model that say when its bounds are computed anew.
struct Adaption {
  std::uint32_t total = 0;  // symbols counted
  std::uint32_t cycle = 0;  // symbols from one update to the next
  std::uint32_t until_update = 0;
};

// Halves the counts where they have grown too large, computes `bounds` from them, and every `group`-th of those to
// `coarse`, if that is not null.
void update_bounds(Adaption& adaption, std::span<std::uint16_t> counts, std::uint16_t* bounds, unsigned group,
                   std::uint16_t* coarse);

// A model of up to kCapacity symbols.
template <unsigned kCapacity>
struct SymbolModel {
  static_assert(kCapacity >= 2 && kCapacity <= 640);
  // Up to 40 bounds are compared in one step; of more, first every kGroup-th
  static constexpr bool kTwoSteps = kCapacity > 40;
  static constexpr unsigned kGroup = kTwoSteps ? (kCapacity <= 128 ? 8 : 16) : 1;
  static constexpr unsigned kCoarse = kTwoSteps ? ((kCapacity + kGroup - 1) / kGroup + 7) / 8 * 8 : 0;
  static constexpr unsigned kBounds = (kCapacity + 16) / 16 * 16;  // one more than symbols, so that [symbol + 1] exists
  static constexpr unsigned kCompared = (kCapacity + 7) / 8 * 8;

  alignas(16) std::array<std::uint16_t, kBounds> bounds;
  alignas(16) std::array<std::uint16_t, kCoarse> coarse;  // bounds of the groups
  std::array<std::uint16_t, kCapacity> counts;            // at most 2^15 + one cycle
  Adaption adaption;
  std::uint32_t last;  // the highest symbol

  // All symbols are equally likely. `symbols` is 2 to kCapacity.
  void init(unsigned symbols = kCapacity) {
    bounds.fill(kNoBound);
    coarse.fill(kNoBound);
    for (unsigned i = 0; i < symbols; ++i) counts[i] = 1;
    last = symbols - 1;
    adaption = {0, symbols, 0};
    update();
    adaption.cycle = adaption.until_update = (symbols + 6) / 2;
  }

  void update() {
    update_bounds(adaption, {counts.data(), last + 1}, bounds.data(), kGroup, kTwoSteps ? coarse.data() : nullptr);
  }

  // The symbol whose share of the interval holds `place`.
  [[gnu::always_inline]] unsigned find(std::uint32_t place) const {
    if constexpr (kTwoSteps) {
      const unsigned first = (count_at_most<kCoarse>(coarse.data(), place) - 1) * kGroup;
      return first + count_at_most<kGroup>(bounds.data() + first, place) - 1;
    } else {
      return count_at_most<kCompared>(bounds.data(), place) - 1;
    }
  }

  [[gnu::always_inline]] void count(unsigned symbol) {
    ++counts[symbol];
    if (--adaption.until_update == 0) [[unlikely]]
      update();
  }
};

// A model of one bit.
struct BitModel {
  std::uint32_t zero_share;  // of 2^13
  std::uint32_t zeros;
  std::uint32_t total;
  std::uint32_t cycle;
  std::uint32_t until_update;

  void init() { *this = {1u << (kBitShift - 1), 1, 2, 4, 4}; }
  void update();
};

}  // namespace stipple::laz
