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
    last_.intensity = 0;
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

  [[gnu::always_inline]] void decode(ArithmeticDecoder& decoder, std::byte* out) {
    const unsigned changed = decoder.symbol(changed_);
    if (changed & kFlags) last_.flags = static_cast<std::uint8_t>(decoder.symbol(flags_[last_.flags]));
    const unsigned number = last_.flags & 7u;
    const unsigned count = last_.flags >> 3 & 7u;
    const unsigned context = kReturnContext8[count][number];
    if (changed & kIntensity)
      intensities_[context] =
          static_cast<std::uint16_t>(intensity_.decode(decoder, intensities_[context], std::min(context, 3u)));
    last_.intensity = intensities_[context];
    if (changed & (kClass | kAngle | kUserData | kSource)) decode_rare(decoder, changed);

    const bool single = count == 1;
    const std::int32_t dx = dx_.decode(decoder, x_steps_[context].get(), single);
    last_.x = wrapping_add(last_.x, dx);
    x_steps_[context].add(dx);

    const unsigned x_class = dx_.correction_class();
    const std::int32_t dy = dy_.decode(decoder, y_steps_[context].get(), (x_class < 20 ? x_class & ~1u : 20u) + single);
    last_.y = wrapping_add(last_.y, dy);
    y_steps_[context].add(dy);

    const unsigned mean_class = (x_class + dy_.correction_class()) / 2;
    std::int32_t& height = heights_[return_level(count, number)];
    height = z_.decode(decoder, height, (mean_class < 18 ? mean_class & ~1u : 18u) + single);
    last_.z = height;
    store(out, last_);
  }

 private:
  // A record's first bytes
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
  static constexpr std::size_t kSize = 6;
  void begin(const std::byte* first) {
    last_ = load<Colour>(first);
    models_.init();
  }
  [[gnu::always_inline]] void decode(ArithmeticDecoder& decoder, std::byte* out) {
    last_ = models_.decode(decoder, last_);
    store(out, last_);
  }

 private:
  using Colour = std::array<std::uint16_t, 3>;
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
