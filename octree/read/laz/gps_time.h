// GPS times of items version 2 and of layered points: four sequences of times, each continued by multiples of its last
// difference.
#pragma once

#include "octree/read/laz/item_common.h"

namespace stipple::laz {

// Source: LASzip specification, "GPSTIME11 version 2" and "POINT14, gps_time layer". The two differ in whether a code
// for "unchanged" exists: kUnchanged is 1 in the former, 0 in the latter, where a flag elsewhere says so.
template <unsigned kUnchanged>
class GpsTimeDecoder {
 public:
  void init(std::uint64_t first) {
    multiples_.init();
    starts_.init();
    differences_.init();
    sequences_ = {};
    sequences_[0].time = first;
    current_ = newest_ = 0;
  }

  std::uint64_t last() const { return sequences_[current_].time; }

  [[gnu::always_inline]] std::uint64_t decode(ArithmeticDecoder& decoder) {
    // An encoder changes the sequence once at most. What does so without end is damaged.
    for (int changes = 0; changes < 4; ++changes)
      if (advance(decoder)) return last();
    decoder.broken = 1;
    return last();
  }

 private:
  static constexpr int kMostTimes = 500;
  static constexpr int kLeastTimes = -10;
  static constexpr int kFarJump = kMostTimes - kLeastTimes + 1 + static_cast<int>(kUnchanged);
  static constexpr unsigned kCodes = static_cast<unsigned>(kFarJump) + 4;
  static constexpr std::uint32_t kMostExtremes = 3;

  struct Sequence {
    std::uint64_t time = 0;  // the bits of a double
    std::int32_t difference = 0;
    std::uint32_t extremes = 0;  // differences in a row that were no small multiple
  };

  // Whether that was a time, not a change of the sequence.
  [[gnu::always_inline]] bool advance(ArithmeticDecoder& decoder) {
    Sequence& sequence = sequences_[current_];
    return sequence.difference == 0 ? start(decoder, sequence) : proceed(decoder, sequence);
  }

  bool start(ArithmeticDecoder& decoder, Sequence& sequence) {
    const unsigned code = decoder.symbol(starts_);
    if (code + 1 == kUnchanged) return true;
    const unsigned step = code - kUnchanged;
    if (step == 0) {
      sequence.difference = differences_.decode(decoder, 0, 0);
      add(sequence, sequence.difference);
      sequence.extremes = 0;
    } else if (step == 1) {
      jump(decoder, sequence);
    } else {
      current_ = (current_ + step - 1) & 3u;
      return false;
    }
    return true;
  }

  [[gnu::always_inline]] bool proceed(ArithmeticDecoder& decoder, Sequence& sequence) {
    const int code = static_cast<int>(decoder.symbol(multiples_));
    if (code == 1) {
      add(sequence, differences_.decode(decoder, sequence.difference, 1));
      sequence.extremes = 0;
      return true;
    }
    if (code < kFarJump - static_cast<int>(kUnchanged)) {
      multiple(decoder, sequence, code);
      return true;
    }
    if (code < kFarJump) return true;  // unchanged
    if (code == kFarJump) {
      jump(decoder, sequence);
      return true;
    }
    current_ = (current_ + static_cast<unsigned>(code - kFarJump)) & 3u;
    return false;
  }

  void multiple(ArithmeticDecoder& decoder, Sequence& sequence, int code) {
    // Codes above the largest multiple stand for negative ones
    const int times = code <= kMostTimes ? code : kMostTimes - code;
    const bool extreme = times == 0 || times == kMostTimes || times <= kLeastTimes;
    const std::int32_t difference =
        differences_.decode(decoder, wrapping_times(std::max(times, kLeastTimes), sequence.difference), context(times));
    if (extreme && ++sequence.extremes > kMostExtremes) {
      sequence.difference = difference;
      sequence.extremes = 0;
    }
    add(sequence, difference);
  }

  static unsigned context(int times) {
    if (times == 0) return 7;
    if (times < 0) return times > kLeastTimes ? 5 : 6;
    if (times < 10) return 2;
    return times < kMostTimes ? 3 : 4;
  }

  // A time too far away for 32 bits begins a sequence.
  void jump(ArithmeticDecoder& decoder, const Sequence& from) {
    const auto high =
        static_cast<std::uint32_t>(differences_.decode(decoder, static_cast<std::int32_t>(from.time >> 32), 8));
    newest_ = (newest_ + 1) & 3u;
    current_ = newest_;
    sequences_[current_] = {std::uint64_t{high} << 32 | decoder.bits(32), 0, 0};
  }

  static void add(Sequence& sequence, std::int32_t difference) {
    sequence.time += static_cast<std::uint64_t>(std::int64_t{difference});
  }

  SymbolModel<kCodes> multiples_;
  SymbolModel<5 + kUnchanged> starts_;
  IntegerDecoder<32, 9> differences_;
  std::array<Sequence, 4> sequences_;
  unsigned current_ = 0;
  unsigned newest_ = 0;
};

}  // namespace stipple::laz
