// The items of a point from the writer's side: version 2, and 3 of the layered formats. Where the format leaves a
// writer a choice, the plainest is taken. Source: LASzip specification, "POINT10", "GPSTIME11", "RGB12", "POINT14" and
// others.
#pragma once

#include <cmath>
#include <map>
#include <optional>

#include "octree/read/laz/return_context.h"
#include "tests/read/laz_encoder.h"
#include "tests/read/laz_fixture.h"

namespace stipple::test {

// Models made when they are first asked for.
class SymbolTables {
 public:
  explicit SymbolTables(std::uint32_t symbols) : symbols_(symbols) {}
  SymbolCounts& operator[](unsigned index) { return models_.try_emplace(index, symbols_).first->second; }

 private:
  std::uint32_t symbols_;
  std::map<unsigned, SymbolCounts> models_;
};

// Of five values, which begin as zeros.
class RunningMedian {
 public:
  std::int32_t get() const { return values_[2]; }
  void add(std::int32_t value) {
    const std::int32_t middle = values_[2];
    values_[drop_largest_ ? 4 : 0] = value;
    std::ranges::sort(values_);
    drop_largest_ = drop_largest_ ? value < middle : value <= middle;
  }

 private:
  std::array<std::int32_t, 5> values_{};
  bool drop_largest_ = true;
};

inline std::int32_t difference(std::int32_t a, std::int32_t b) {
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) - static_cast<std::uint32_t>(b));
}

// A record of POINT10, or POINT14 as far as it is the same.
struct PointFields {
  std::int32_t x, y, z;
  std::uint16_t intensity;
  std::uint8_t flags, classification, angle, user_data;
  std::uint16_t source;

  explicit PointFields(const std::byte* record) { std::memcpy(this, record, 20); }
};

class Point10Encoder {
 public:
  explicit Point10Encoder(const std::byte* first) : last_(first) {}

  void encode(ArithmeticEncoder& out, const std::byte* record) {
    const PointFields p(record);
    const unsigned number = p.flags & 7u, count = p.flags >> 3 & 7u;
    const unsigned context = laz::kReturnContext8[count][number];
    std::uint16_t& intensity = intensities_[context];
    const unsigned changed = (p.flags != last_.flags) << 5 | (p.intensity != intensity) << 4 |
                             (p.classification != last_.classification) << 3 | (p.angle != last_.angle) << 2 |
                             (p.user_data != last_.user_data) << 1 | (p.source != last_.source);
    out.symbol(changed_, changed);
    if (changed & 32) out.symbol(flags_[last_.flags], p.flags);
    if (changed & 16) intensity_.encode(out, intensity, p.intensity, std::min(context, 3u));
    intensity = p.intensity;
    if (changed & 8) out.symbol(classes_[last_.classification], p.classification);
    if (changed & 4) out.symbol(angles_[p.flags >> 6 & 1u], static_cast<std::uint8_t>(p.angle - last_.angle));
    if (changed & 2) out.symbol(user_data_[last_.user_data], p.user_data);
    if (changed & 1) source_.encode(out, last_.source, p.source);
    encode_position(out, p, context, count, laz::return_level(count, number));
    last_ = p;
  }

 private:
  void encode_position(ArithmeticEncoder& out, const PointFields& p, unsigned context, unsigned count, unsigned level) {
    const unsigned single = count == 1;
    const std::int32_t dx = difference(p.x, last_.x), dy = difference(p.y, last_.y);
    dx_.encode(out, x_steps_[context].get(), dx, single);
    x_steps_[context].add(dx);
    const unsigned x_class = dx_.correction_class();
    dy_.encode(out, y_steps_[context].get(), dy, (x_class < 20 ? x_class & ~1u : 20u) + single);
    y_steps_[context].add(dy);
    const unsigned mean = (x_class + dy_.correction_class()) / 2;
    z_.encode(out, heights_[level], p.z, (mean < 18 ? mean & ~1u : 18u) + single);
    heights_[level] = p.z;
  }

  PointFields last_;
  SymbolCounts changed_{64};
  SymbolTables flags_{256}, classes_{256}, user_data_{256}, angles_{256};
  IntegerEncoder intensity_{16, 4}, source_{16, 1}, dx_{32, 2}, dy_{32, 22}, z_{32, 20};
  std::array<RunningMedian, 16> x_steps_, y_steps_;
  std::array<std::uint16_t, 16> intensities_{};
  std::array<std::int32_t, 8> heights_{};
};

// `unchanged`: 1 where a code says so (GPSTIME11), 0 where a flag elsewhere does (POINT14).
class GpsTimeEncoder {
 public:
  GpsTimeEncoder(std::uint64_t first, unsigned unchanged)
      : unchanged_(unchanged), far_(511 + unchanged), multiples_(515 + unchanged), starts_(5 + unchanged) {
    sequences_[0].time = first;
  }

  void encode(ArithmeticEncoder& out, std::uint64_t time) {
    Sequence& s = sequences_[current_];
    if (unchanged_ && time == s.time) return out.symbol(s.step == 0 ? starts_ : multiples_, s.step == 0 ? 0 : 511);
    if (const auto step = step_to(s, time)) return encode_step(out, s, *step);
    for (unsigned other = 1; other < 4; ++other)
      if (step_to(sequences_[(current_ + other) & 3u], time)) {
        code(out, s, unchanged_ + 1 + other, far_ + other);
        current_ = (current_ + other) & 3u;
        return encode(out, time);
      }
    code(out, s, unchanged_ + 1, far_);
    differences_.encode(out, static_cast<std::int32_t>(s.time >> 32), static_cast<std::int32_t>(time >> 32), 8);
    out.bits(static_cast<std::uint32_t>(time), 32);
    current_ = newest_ = (newest_ + 1) & 3u;
    sequences_[current_] = {time, 0, 0};
  }

 private:
  struct Sequence {
    std::uint64_t time = 0;
    std::int32_t step = 0;
    unsigned extremes = 0;
  };

  static std::optional<std::int32_t> step_to(const Sequence& from, std::uint64_t time) {
    const auto step = static_cast<std::int64_t>(time - from.time);
    return step == static_cast<std::int32_t>(step) ? std::optional(static_cast<std::int32_t>(step)) : std::nullopt;
  }
  void code(ArithmeticEncoder& out, const Sequence& s, unsigned start, unsigned multiple) {
    s.step == 0 ? out.symbol(starts_, start) : out.symbol(multiples_, multiple);
  }

  void encode_step(ArithmeticEncoder& out, Sequence& s, std::int32_t step) {
    s.time += static_cast<std::uint64_t>(std::int64_t{step});
    if (s.step == 0) {
      out.symbol(starts_, unchanged_);
      differences_.encode(out, 0, step, 0);
      s = {s.time, step, 0};
      return;
    }
    const int times = static_cast<int>(std::clamp(std::round(double{1} * step / s.step), -10.0, 500.0));
    out.symbol(multiples_, static_cast<std::uint32_t>(times >= 0 ? times : 500 - times));
    const auto expected =
        static_cast<std::int32_t>(static_cast<std::uint32_t>(times) * static_cast<std::uint32_t>(s.step));
    const unsigned context = times == 0     ? 7
                             : times == 1   ? 1
                             : times == -10 ? 6
                             : times < 0    ? 5
                             : times < 10   ? 2
                             : times < 500  ? 3
                                            : 4;
    differences_.encode(out, expected, step, context);
    if (times == 1) s.extremes = 0;
    if ((times == 0 || times == 500 || times == -10) && ++s.extremes > 3) s = {s.time, step, 0};
  }

  unsigned unchanged_, far_;
  SymbolCounts multiples_, starts_;
  IntegerEncoder differences_{32, 9};
  std::array<Sequence, 4> sequences_;
  unsigned current_ = 0, newest_ = 0;
};

class RgbEncoder {
 public:
  explicit RgbEncoder(const std::byte* first) : last_(bytes(first)) {}

  // Bytes 0 to 5: red low, red high, green low, ...
  void encode(ArithmeticEncoder& out, const std::byte* record) {
    const Colour now = bytes(record);
    unsigned changed = (now[0] != now[2] || now[0] != now[4] || now[1] != now[3] || now[1] != now[5]) << 6;
    for (unsigned i = 0; i < 6; ++i) changed |= (now[i] != last_[i]) << i;
    out.symbol(changed_, changed);
    const auto byte = [&](unsigned i, int expected) {
      if (changed >> i & 1u) out.symbol(differences_[i], static_cast<std::uint8_t>(now[i] - expected));
    };
    byte(0, last_[0]);
    byte(1, last_[1]);
    for (unsigned half = 0; half < 2 && changed >> 6; ++half) {
      const int red = now[half] - last_[half];
      byte(2 + half, std::clamp(red + last_[2 + half], 0, 255));
      byte(4 + half, std::clamp((red + now[2 + half] - last_[2 + half]) / 2 + last_[4 + half], 0, 255));
    }
    last_ = now;
  }

 private:
  using Colour = std::array<int, 6>;
  static Colour bytes(const std::byte* at) {
    Colour colour;
    for (std::size_t i = 0; i < 6; ++i) colour[i] = std::to_integer<int>(at[i]);
    return colour;
  }
  Colour last_;
  SymbolCounts changed_{128};
  SymbolTables differences_{256};
};

class ExtraByteEncoder {
 public:
  explicit ExtraByteEncoder(std::byte first) : last_(first) {}
  void encode(ArithmeticEncoder& out, std::byte value) {
    out.symbol(model_, static_cast<std::uint8_t>(std::to_integer<int>(value) - std::to_integer<int>(last_)));
    last_ = value;
  }

 private:
  std::byte last_;
  SymbolCounts model_{256};
};

}  // namespace stipple::test
