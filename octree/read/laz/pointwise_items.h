// Items of point formats 0 to 5, version 2, as every writer since 2011 makes them. Version 1: pointwise_items_v1.h.
//
// An item is begun with the bytes of a chunk's first point, which stand uncompressed, and then decodes its part of one
// point after the other. Source: LASzip specification, "POINT10", "GPSTIME11", "RGB12", "WAVEPACKET13", "BYTE".
#pragma once

#include <vector>

#include "octree/read/laz/gps_time.h"
#include "octree/read/laz/item_common.h"
#include "octree/read/laz/return_context.h"

namespace stipple::laz {

// Position, intensity, returns, flags, classification, angle, user data, source: bytes 0 to 19 of a record.
class Point10 {
 public:
  static constexpr std::size_t kSize = 20;

  void begin(const std::byte* first) {
    last_ = load<Fields>(first);
    for (auto& median : x_steps_) median.init();
    for (auto& median : y_steps_) median.init();
    intensities_ = {};
    heights_ = {};
    changed_.init();
    intensity_.init();
    for (auto& model : angles_) model.init();
    source_.init();
    flags_.forget();
    classes_.forget();
    user_data_.forget();
    dx_.init();
    dy_.init();
    z_.init();
  }

  // A point is decoded in steps, in this order, so that a loop can do something else in between.
  static constexpr unsigned kSteps = 4;
  // What one step leaves to the next.
  struct Context {
    unsigned returns;
    unsigned level;
    bool single;
  };

  template <unsigned kStep>
  [[gnu::always_inline]] void decode(ArithmeticDecoder& decoder, Context& context, std::byte* out) {
    if constexpr (kStep == 0)
      decode_changes(decoder, context, out);
    else if constexpr (kStep == 1)
      decode_x(decoder, context, out);
    else if constexpr (kStep == 2)
      decode_y(decoder, context, out);
    else
      decode_z(decoder, context, out);
  }

 private:
  // A record's first bytes. Of z and intensity, only those of the first point
  struct Fields {
    std::int32_t x, y, z;
    std::uint16_t intensity;
    std::uint8_t flags;  // return number, number of returns, direction, edge
    std::uint8_t classification;
    std::uint8_t angle;
    std::uint8_t user_data;
    std::uint16_t source;
  };
  static_assert(sizeof(Fields) == kSize);

  enum : unsigned { kSource = 1, kUserData = 2, kAngle = 4, kClass = 8, kIntensity = 16, kFlags = 32 };

  // Each step writes what it decoded: the whole of last_, read back after it was written in parts, would have to wait.
  [[gnu::always_inline]] void decode_changes(ArithmeticDecoder& decoder, Context& context, std::byte* out) {
    const unsigned changed = decoder.symbol(changed_);
    if (changed & kFlags) last_.flags = static_cast<std::uint8_t>(decoder.symbol(flags_[last_.flags]));
    const unsigned number = last_.flags & 7u;
    const unsigned count = last_.flags >> 3 & 7u;
    context = {kReturnContext8[count][number], return_level(count, number), count == 1};
    std::uint16_t intensity = intensities_[context.returns];
    if (changed & kIntensity)
      intensity = static_cast<std::uint16_t>(intensity_.decode(decoder, intensity, std::min(context.returns, 3u)));
    intensities_[context.returns] = intensity;
    if (changed & (kClass | kAngle | kUserData | kSource)) decode_rare(decoder, changed);
    store(out + 12, intensity);
    store(out + 14, last_.flags);
    std::memcpy(out + 15, reinterpret_cast<const std::byte*>(&last_) + 15, kSize - 15);
  }

  [[gnu::always_inline]] void decode_x(ArithmeticDecoder& decoder, const Context& context, std::byte* out) {
    Median& steps = x_steps_[context.returns];
    const std::int32_t step = dx_.decode(decoder, steps.get(), context.single);
    const std::int32_t x = wrapping_add(last_.x, step);
    steps.add(step);
    last_.x = x;
    store(out, x);
  }

  [[gnu::always_inline]] void decode_y(ArithmeticDecoder& decoder, const Context& context, std::byte* out) {
    const unsigned x_class = dx_.correction_class();
    Median& steps = y_steps_[context.returns];
    const std::int32_t step = dy_.decode(decoder, steps.get(), (x_class < 20 ? x_class & ~1u : 20u) + context.single);
    const std::int32_t y = wrapping_add(last_.y, step);
    steps.add(step);
    last_.y = y;
    store(out + 4, y);
  }

  [[gnu::always_inline]] void decode_z(ArithmeticDecoder& decoder, const Context& context, std::byte* out) {
    const unsigned mean_class = (dx_.correction_class() + dy_.correction_class()) / 2;
    std::int32_t& height = heights_[context.level];
    const std::int32_t z = z_.decode(decoder, height, (mean_class < 18 ? mean_class & ~1u : 18u) + context.single);
    height = z;
    store(out + 8, z);
  }

  void decode_rare(ArithmeticDecoder& decoder, unsigned changed) {
    if (changed & kClass)
      last_.classification = static_cast<std::uint8_t>(decoder.symbol(classes_[last_.classification]));
    if (changed & kAngle)
      last_.angle = static_cast<std::uint8_t>(last_.angle + decoder.symbol(angles_[last_.flags >> 6 & 1u]));
    if (changed & kUserData) last_.user_data = static_cast<std::uint8_t>(decoder.symbol(user_data_[last_.user_data]));
    if (changed & kSource) last_.source = static_cast<std::uint16_t>(source_.decode(decoder, last_.source));
  }

  Fields last_;
  SymbolModel<64> changed_;
  std::array<std::uint16_t, 16> intensities_;  // by context of returns
  std::array<std::int32_t, kReturnLevels> heights_;
  std::array<Median, 16> x_steps_;
  std::array<Median, 16> y_steps_;
  IntegerDecoder<32, 2> dx_;
  IntegerDecoder<32, 22> dy_;
  IntegerDecoder<32, 20> z_;
  IntegerDecoder<16, 4> intensity_;
  IntegerDecoder<16, 1> source_;
  std::array<SymbolModel<256>, 2> angles_;  // by direction of the scan
  LazyModels<256, 256> flags_;
  LazyModels<256, 256> classes_;
  LazyModels<256, 256> user_data_;
};

class GpsTime11 {
 public:
  static constexpr std::size_t kSize = 8;
  void begin(const std::byte* first) { times_.init(load<std::uint64_t>(first)); }
  [[gnu::always_inline]] void decode(ArithmeticDecoder& decoder, std::byte* out) { store(out, times_.decode(decoder)); }

 private:
  GpsTimeDecoder<1> times_;
};

class Rgb12 {
 public:
  static constexpr std::size_t kSize = Colour::kSize;
  void begin(const std::byte* first) {
    last_ = Colour::load(first);
    models_.init();
  }
  [[gnu::always_inline]] void decode(ArithmeticDecoder& decoder, std::byte* out) {
    last_ = models_.decode(decoder, last_);
    last_.store(out);
  }

 private:
  Colour last_;
  ColourModels models_;
};

// Extra bytes, each by itself.
class Bytes {
 public:
  void begin(const std::byte* first, std::size_t count) {
    last_.assign(first, first + count);
    models_.resize(count);
    for (auto& model : models_) model.init();
  }
  void decode(ArithmeticDecoder& decoder, std::byte* out) {
    for (std::size_t i = 0; i < last_.size(); ++i) {
      last_[i] = static_cast<std::byte>(std::to_integer<unsigned>(last_[i]) + decoder.symbol(models_[i]));
      out[i] = last_[i];
    }
  }

 private:
  std::vector<std::byte> last_;
  std::vector<SymbolModel<256>> models_;
};

}  // namespace stipple::laz
