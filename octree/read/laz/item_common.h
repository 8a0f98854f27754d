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
    // The four that stay are side by side. Which these are is hard to predict, so it is an address, not a jump
    const std::int32_t middle = sorted_[2];
    const std::int32_t* const kept = sorted_.data() + (drop_largest_ ? 0 : 1);
    const std::int32_t a = kept[0], b = kept[1], c = kept[2], d = kept[3];
    drop_largest_ = (v < middle) | ((v == middle) & !drop_largest_);
    sorted_ = {lower(a, v), upper(a, lower(b, v)), upper(b, lower(c, v)), upper(c, lower(d, v)), upper(d, v)};
  }

 private:
  // By value: std::min and std::max choose between addresses, and that with a jump.
  static std::int32_t lower(std::int32_t a, std::int32_t b) { return a < b ? a : b; }
  static std::int32_t upper(std::int32_t a, std::int32_t b) { return a < b ? b : a; }

  std::array<std::int32_t, 5> sorted_;  // ascending
  bool drop_largest_;
};

// Red, green and blue side by side, 16 bits each from the lowest up: one register, written and read back as a whole.
// What is written in parts and read as a whole has to wait until the parts are in the cache.
struct Colour {
  static constexpr std::size_t kSize = 6;

  std::uint64_t bits = 0;

  static Colour load(const std::byte* at) {
    return {laz::load<std::uint32_t>(at) | std::uint64_t{laz::load<std::uint16_t>(at + 4)} << 32};
  }
  [[gnu::always_inline]] void store(std::byte* at) const {
    laz::store(at, static_cast<std::uint32_t>(bits));
    laz::store(at + 4, static_cast<std::uint16_t>(bits >> 32));
  }
  // Byte 0 to 5: red low, red high, green low, ...
  [[gnu::always_inline]] int byte(unsigned index) const { return static_cast<int>(bits >> (8 * index) & 255u); }
};

// The colour bytes that differ from the last point's, each predicted from the one before. Source: LASzip specification,
// "RGB12 version 2". Bits of `changed`: 0 to 5 for the bytes of Colour, and 6: not all three colours are equal.
struct ColourModels {
  SymbolModel<128> changed;
  std::array<SymbolModel<256>, 6> differences;

  void init() {
    changed.init();
    for (auto& model : differences) model.init();
  }
  [[gnu::always_inline]] Colour decode(ArithmeticDecoder& decoder, Colour last);
};

[[gnu::always_inline]] inline int clamp_to_byte(int value) {
  return std::clamp(value, 0, 255);
}

[[gnu::always_inline]] inline Colour ColourModels::decode(ArithmeticDecoder& decoder, Colour last) {
  const unsigned change = decoder.symbol(changed);
  // A byte: kept, or its prediction and a difference
  const auto byte = [&](unsigned index, int predicted) {
    if ((change >> index & 1u) == 0) return last.byte(index);
    return static_cast<int>(decoder.symbol(differences[index]) + static_cast<unsigned>(predicted)) & 255;
  };
  const int red_low = byte(0, last.byte(0));
  const int red_high = byte(1, last.byte(1));
  const auto colour = [](int low, int high) { return static_cast<std::uint64_t>(high << 8 | low); };
  const std::uint64_t red = colour(red_low, red_high);
  if ((change >> 6 & 1u) == 0) return {red | red << 16 | red << 32};

  int step = red_low - last.byte(0);
  const int green_low = byte(2, clamp_to_byte(step + last.byte(2)));
  step = (step + green_low - last.byte(2)) / 2;
  const int blue_low = byte(4, clamp_to_byte(step + last.byte(4)));
  step = red_high - last.byte(1);
  const int green_high = byte(3, clamp_to_byte(step + last.byte(3)));
  step = (step + green_high - last.byte(3)) / 2;
  const int blue_high = byte(5, clamp_to_byte(step + last.byte(5)));
  return {red | colour(green_low, green_high) << 16 | colour(blue_low, blue_high) << 32};
}

}  // namespace stipple::laz
