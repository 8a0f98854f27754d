// Items of point formats 0 to 5, version 1: files of the years up to 2011. See pointwise_items.h.
#pragma once

#include <vector>

#include "octree/read/laz/item_common.h"

namespace stipple::laz {

class Point10V1 {
 public:
  static constexpr std::size_t kSize = 20;

  void begin(const std::byte* first) {
    last_ = load<Fields>(first);
    x_steps_ = {};
    y_steps_ = {};
    oldest_ = 0;
    dx_.init();
    dy_.init();
    z_.init();
    intensity_.init();
    angle_.init();
    source_.init();
    changed_.init();
    flags_.forget();
    classes_.forget();
    user_data_.forget();
  }

  static constexpr unsigned kSteps = 1;
  struct Context {};

  template <unsigned kStep>
  void decode(ArithmeticDecoder& decoder, Context&, std::byte* out) {
    const std::int32_t dx = dx_.decode(decoder, median(x_steps_));
    last_.x = wrapping_add(last_.x, dx);
    const unsigned x_class = dx_.correction_class();
    const std::int32_t dy = dy_.decode(decoder, median(y_steps_), std::min(x_class, 19u));
    last_.y = wrapping_add(last_.y, dy);
    const unsigned mean_class = (x_class + dy_.correction_class()) / 2;
    last_.z = z_.decode(decoder, last_.z, std::min(mean_class, 19u));
    decode_changes(decoder, decoder.symbol(changed_), mean_class);
    x_steps_[oldest_] = dx;
    y_steps_[oldest_] = dy;
    oldest_ = (oldest_ + 1) % 3;
    store(out, last_);
  }

 private:
  struct Fields {
    std::int32_t x, y, z;
    std::uint16_t intensity;
    std::uint8_t flags;
    std::uint8_t classification;
    std::uint8_t angle;
    std::uint8_t user_data;
    std::uint16_t source;
  };
  static_assert(sizeof(Fields) == kSize);
  using Steps = std::array<std::int32_t, 3>;

  static std::int32_t median(const Steps& s) {
    return std::max(std::min(s[0], s[1]), std::min(std::max(s[0], s[1]), s[2]));
  }

  void decode_changes(ArithmeticDecoder& decoder, unsigned changed, unsigned mean_class) {
    if (changed & 32) last_.intensity = static_cast<std::uint16_t>(intensity_.decode(decoder, last_.intensity));
    if (changed & 16) last_.flags = static_cast<std::uint8_t>(decoder.symbol(flags_[last_.flags]));
    if (changed & 8) last_.classification = static_cast<std::uint8_t>(decoder.symbol(classes_[last_.classification]));
    if (changed & 4) last_.angle = static_cast<std::uint8_t>(angle_.decode(decoder, last_.angle, mean_class < 3));
    if (changed & 2) last_.user_data = static_cast<std::uint8_t>(decoder.symbol(user_data_[last_.user_data]));
    if (changed & 1) last_.source = static_cast<std::uint16_t>(source_.decode(decoder, last_.source));
  }

  Fields last_;
  Steps x_steps_;  // of the last three points
  Steps y_steps_;
  unsigned oldest_ = 0;
  IntegerDecoder<32, 1> dx_;
  IntegerDecoder<32, 20> dy_;
  IntegerDecoder<32, 20> z_;
  IntegerDecoder<16, 1> intensity_;
  IntegerDecoder<8, 2> angle_;
  IntegerDecoder<16, 1> source_;
  SymbolModel<64> changed_;
  LazyModels<256, 256> flags_;
  LazyModels<256, 256> classes_;
  LazyModels<256, 256> user_data_;
};

class GpsTime11V1 {
 public:
  static constexpr std::size_t kSize = 8;

  void begin(const std::byte* first) {
    time_ = load<std::uint64_t>(first);
    difference_ = 0;
    extremes_ = 0;
    multiples_.init();
    starts_.init();
    differences_.init();
  }

  void decode(ArithmeticDecoder& decoder, std::byte* out) {
    if (difference_ == 0)
      start(decoder);
    else
      proceed(decoder);
    store(out, time_);
  }

 private:
  static constexpr int kCodes = 512;
  static constexpr int kMostTimes = kCodes - 3;
  static constexpr int kFarJump = kCodes - 2;  // the code above it: unchanged

  void start(ArithmeticDecoder& decoder) {
    const unsigned code = decoder.symbol(starts_);
    if (code == 1) {
      difference_ = differences_.decode(decoder, 0, 0);
      add(difference_);
    } else if (code == 2) {
      time_ = decoder.bits64();
    }
  }

  void proceed(ArithmeticDecoder& decoder) {
    const int code = static_cast<int>(decoder.symbol(multiples_));
    if (code == kFarJump) time_ = decoder.bits64();
    if (code >= kFarJump) return;
    const std::int32_t predicted = code == 0 ? difference_ / 4 : wrapping_times(code, difference_);
    const std::int32_t difference = differences_.decode(decoder, predicted, context(code));
    if (code == 1) extremes_ = 0;
    const bool extreme = (code == 0 || code == kMostTimes) && ++extremes_ > 3;
    if (extreme) extremes_ = 0;
    if (extreme || code == 1) difference_ = difference;
    add(difference);
  }

  static unsigned context(int times) {
    if (times == 0) return 2;
    if (times == 1) return 1;
    if (times < 10) return 3;
    return times < 50 ? 4 : 5;
  }

  void add(std::int32_t difference) { time_ += static_cast<std::uint64_t>(std::int64_t{difference}); }

  std::uint64_t time_ = 0;  // the bits of a double
  std::int32_t difference_ = 0;
  std::uint32_t extremes_ = 0;
  SymbolModel<kCodes> multiples_;
  SymbolModel<3> starts_;
  IntegerDecoder<32, 6> differences_;
};

class Rgb12V1 {
 public:
  static constexpr std::size_t kSize = 6;

  void begin(const std::byte* first) {
    last_ = load<std::array<std::uint8_t, kSize>>(first);
    changed_.init();
    bytes_.init();
  }
  void decode(ArithmeticDecoder& decoder, std::byte* out) {
    const unsigned changed = decoder.symbol(changed_);
    for (unsigned i = 0; i < kSize; ++i)
      if (changed >> i & 1u) last_[i] = static_cast<std::uint8_t>(bytes_.decode(decoder, last_[i], i));
    store(out, last_);
  }

 private:
  std::array<std::uint8_t, kSize> last_;
  SymbolModel<64> changed_;
  IntegerDecoder<8, 6> bytes_;
};

class BytesV1 {
 public:
  void begin(const std::byte* first, std::size_t count) {
    last_.assign(first, first + count);
    classes_.resize(count);
    for (auto& model : classes_) model.init();
    corrections_.init();
  }
  void decode(ArithmeticDecoder& decoder, std::byte* out) {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      last_[i] =
          static_cast<std::byte>(corrections_.decode(decoder, classes_[i], std::to_integer<std::int32_t>(last_[i])));
      out[i] = last_[i];
    }
  }

 private:
  std::vector<std::byte> last_;
  std::vector<SymbolModel<9>> classes_;
  CorrectionDecoder<8> corrections_;
};

}  // namespace stipple::laz
