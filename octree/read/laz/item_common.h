// What several items of a point share.
#pragma once

#include <algorithm>
#include <array>
#include <bitset>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>

#include "octree/read/laz/integer_decoder.h"

namespace stipple::laz {

template <class T>
[[gnu::always_inline]] inline T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}
template <class T>
[[gnu::always_inline]] inline void store(std::byte* at, T value) {
  std::memcpy(at, &value, sizeof value);
}

// Integers of the format wrap around.
inline std::int32_t wrapping_add(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) + static_cast<std::uint32_t>(b));
}
inline std::int32_t wrapping_times(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) * static_cast<std::uint32_t>(b));
}

// kCount models of which a chunk uses few: each is initialised when it is first asked for.
template <unsigned kSymbols, unsigned kCount>
class LazyModels {
 public:
  void forget() { ready_.reset(); }
  [[gnu::always_inline]] SymbolModel<kSymbols>& operator[](unsigned index) {
    if (!ready_[index]) [[unlikely]]
      prepare(index);
    return models_[index];
  }

 private:
  [[gnu::noinline]] void prepare(unsigned index) {
    models_[index].init();
    ready_[index] = true;
  }

  std::bitset<kCount> ready_;
  std::unique_ptr<SymbolModel<kSymbols>[]> models_ = std::make_unique_for_overwrite<SymbolModel<kSymbols>[]>(kCount);
};

// A running median of about five values: inserting one drops the largest or the smallest, by turns when values go up
// and down. Source: LASzip specification, "StreamingMedian5".
class Median {
 public:
  void init() {
    sorted_ = {};
    drop_largest_ = true;
  }
  std::int32_t get() const { return sorted_[2]; }
  [[gnu::always_inline]] void add(std::int32_t v) {
    // The four that stay, then `v` at its place among them
    const bool high = drop_largest_;
    const std::int32_t a = high ? sorted_[0] : sorted_[1];
    const std::int32_t b = high ? sorted_[1] : sorted_[2];
    const std::int32_t c = high ? sorted_[2] : sorted_[3];
    const std::int32_t d = high ? sorted_[3] : sorted_[4];
    drop_largest_ = high ? v < sorted_[2] : v <= sorted_[2];
    sorted_ = {std::min(a, v), std::max(a, std::min(b, v)), std::max(b, std::min(c, v)), std::max(c, std::min(d, v)),
               std::max(d, v)};
  }

 private:
  std::array<std::int32_t, 5> sorted_;  // ascending
  bool drop_largest_;
};

// The three colour bytes that differ from the last point's, high or low, each predicted from the one before.
// Bits of `changed`: red low, red high, green low, green high, blue low, blue high, and 6: not all three are equal.
struct ColourModels {
  SymbolModel<128> changed;
  std::array<SymbolModel<256>, 6> differences;

  void init() {
    changed.init();
    for (auto& model : differences) model.init();
  }
  [[gnu::always_inline]] std::array<std::uint16_t, 3> decode(ArithmeticDecoder& decoder,
                                                             const std::array<std::uint16_t, 3>& last);
};

[[gnu::always_inline]] inline int clamp_to_byte(int value) {
  return std::clamp(value, 0, 255);
}

[[gnu::always_inline]] inline std::array<std::uint16_t, 3> ColourModels::decode(
    ArithmeticDecoder& decoder, const std::array<std::uint16_t, 3>& last) {
  const unsigned change = decoder.symbol(changed);
  // One byte of one colour: kept, or its prediction and a difference
  const auto byte = [&](unsigned index, int kept, int predicted) {
    if ((change >> index & 1u) == 0) return kept;
    return static_cast<int>(decoder.symbol(differences[index]) + static_cast<unsigned>(predicted)) & 255;
  };
  const std::array<int, 3> low{last[0] & 255, last[1] & 255, last[2] & 255};
  const std::array<int, 3> high{last[0] >> 8, last[1] >> 8, last[2] >> 8};
  const int red_low = byte(0, low[0], low[0]);
  const int red_high = byte(1, high[0], high[0]);
  const auto colour = [](int l, int h) { return static_cast<std::uint16_t>(h << 8 | l); };
  const std::uint16_t red = colour(red_low, red_high);
  if ((change >> 6 & 1u) == 0) return {red, red, red};

  int step = red_low - low[0];
  const int green_low = byte(2, low[1], clamp_to_byte(step + low[1]));
  step = (step + green_low - low[1]) / 2;
  const int blue_low = byte(4, low[2], clamp_to_byte(step + low[2]));
  step = red_high - high[0];
  const int green_high = byte(3, high[1], clamp_to_byte(step + high[1]));
  step = (step + green_high - high[1]) / 2;
  const int blue_high = byte(5, high[2], clamp_to_byte(step + high[2]));
  return {red, colour(green_low, green_high), colour(blue_low, blue_high)};
}

}  // namespace stipple::laz
