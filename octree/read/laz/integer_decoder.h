// Integers as corrections of predictions.
#pragma once

#include <array>
#include <cstdint>

#include "octree/read/laz/arithmetic_decoder.h"

namespace stipple::laz {

// Corrections of integers of kBits bits, 8 to 32: class k, the number of bits, by a model of the caller's; then which
// of the 2^k corrections of the class, the upper 8 bits by a model, the others as they are. Source: LASzip
// specification, "Integer compressor".
template <unsigned kBits>
struct CorrectionDecoder {
  using ClassModel = SymbolModel<kBits + 1>;
  static constexpr unsigned kModelledBits = 8;

  BitModel zero_or_one;
  std::array<SymbolModel<256>, kBits> models;  // of class 1, 2, ...
  unsigned correction_class = 0;               // of the last correction: a context for what follows

  void init() {
    zero_or_one.init();
    for (unsigned k = 1; k <= kBits; ++k) models[k - 1].init(1u << (k < kModelledBits ? k : kModelledBits));
    correction_class = 0;
  }

  // The integer of which `prediction` was expected. Wraps around at 2^kBits.
  [[gnu::always_inline]] std::int32_t decode(ArithmeticDecoder& decoder, ClassModel& classes, std::int32_t prediction) {
    const auto sum = static_cast<std::uint32_t>(prediction) + static_cast<std::uint32_t>(correction(decoder, classes));
    if constexpr (kBits < 32)
      return static_cast<std::int32_t>(sum & ((1u << kBits) - 1u));
    else
      return static_cast<std::int32_t>(sum);
  }

 private:
  [[gnu::always_inline]] std::int32_t correction(ArithmeticDecoder& decoder, ClassModel& classes) {
    const unsigned k = decoder.symbol(classes);
    correction_class = k;
    if (k == 0) return static_cast<std::int32_t>(decoder.bit(zero_or_one));
    if constexpr (kBits == 32)
      if (k == 32) return INT32_MIN;
    std::uint32_t c = decoder.symbol(models[k - 1]);
    if (kBits > kModelledBits && k > kModelledBits) {
      const unsigned rest = k - kModelledBits;
      c = c << rest | decoder.bits(rest);
    }
    // The lower half of a class are negative corrections. Nobody can predict the sign: no jump depends on it
    const std::uint32_t negative = ~c >> (k - 1) & 1u;
    return static_cast<std::int32_t>(c + 1u - (negative << k));
  }
};

// As above, with models of the class for kContexts contexts.
template <unsigned kBits, unsigned kContexts>
struct IntegerDecoder {
  std::array<SymbolModel<kBits + 1>, kContexts> classes;
  CorrectionDecoder<kBits> corrections;

  void init() {
    for (auto& model : classes) model.init();
    corrections.init();
  }
  [[gnu::always_inline]] std::int32_t decode(ArithmeticDecoder& decoder, std::int32_t prediction,
                                             unsigned context = 0) {
    return corrections.decode(decoder, classes[context], prediction);
  }
  unsigned correction_class() const { return corrections.correction_class; }
};

}  // namespace stipple::laz
