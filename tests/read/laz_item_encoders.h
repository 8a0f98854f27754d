// The items of a point from the writer's side: version 2, and what the layered formats have of it. Where the format
// leaves a writer a choice, the plainest is taken. Source: LASzip specification, "POINT10", "GPSTIME11", "RGB12",
// "RGBNIR14", "WAVEPACKET13" and "BYTE".
#pragma once

#include <cmath>
#include <map>
#include <optional>

#include "octree/read/laz/return_context.h"
#include "tests/read/laz_encoder.h"

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

template <class T>
T value_at(const std::byte* place) {
  T value;
  std::memcpy(&value, place, sizeof value);
  return value;
}

// A record of POINT10.
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
  explicit GpsTimeEncoder(std::uint64_t first, unsigned unchanged = 1)
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

// Items below take the bytes of the point before and those of the point.
class RgbEncoder {
 public:
  // Bytes 0 to 5: red low, red high, green low, ...
  void encode(ArithmeticEncoder& out, const std::byte* before, const std::byte* record) {
    const Colour last = bytes(before), now = bytes(record);
    unsigned changed = (now[0] != now[2] || now[0] != now[4] || now[1] != now[3] || now[1] != now[5]) << 6;
    for (unsigned i = 0; i < 6; ++i) changed |= (now[i] != last[i]) << i;
    out.symbol(changed_, changed);
    const auto byte = [&](unsigned i, int expected) {
      if (changed >> i & 1u) out.symbol(differences_[i], static_cast<std::uint8_t>(now[i] - expected));
    };
    byte(0, last[0]);
    byte(1, last[1]);
    for (unsigned half = 0; half < 2 && changed >> 6; ++half) {
      const int red = now[half] - last[half];
      byte(2 + half, std::clamp(red + last[2 + half], 0, 255));
      byte(4 + half, std::clamp((red + now[2 + half] - last[2 + half]) / 2 + last[4 + half], 0, 255));
    }
  }

 private:
  using Colour = std::array<int, 6>;
  static Colour bytes(const std::byte* at) {
    Colour colour;
    for (std::size_t i = 0; i < 6; ++i) colour[i] = std::to_integer<int>(at[i]);
    return colour;
  }
  SymbolCounts changed_{128};
  SymbolTables differences_{256};
};

class NirEncoder {
 public:
  void encode(ArithmeticEncoder& out, const std::byte* before, const std::byte* record) {
    const unsigned changed = (record[0] != before[0]) | (record[1] != before[1]) << 1;
    out.symbol(changed_, changed);
    for (unsigned i = 0; i < 2; ++i)
      if (changed >> i & 1u)
        out.symbol(differences_[i],
                   static_cast<std::uint8_t>(std::to_integer<int>(record[i]) - std::to_integer<int>(before[i])));
  }

 private:
  SymbolCounts changed_{4};
  SymbolTables differences_{256};
};

class WavePacketEncoder {
 public:
  void encode(ArithmeticEncoder& out, const std::byte* before, const std::byte* record) {
    out.symbol(index_, std::to_integer<std::uint32_t>(record[0]));
    encode_offset(out, value_at<std::uint64_t>(before + 1), value_at<std::uint64_t>(record + 1),
                  value_at<std::uint32_t>(before + 9));
    size_.encode(out, value_at<std::int32_t>(before + 9), value_at<std::int32_t>(record + 9));
    place_.encode(out, value_at<std::int32_t>(before + 13), value_at<std::int32_t>(record + 13));
    for (unsigned axis = 0; axis < 3; ++axis)
      direction_.encode(out, value_at<std::int32_t>(before + 17 + 4 * axis),
                        value_at<std::int32_t>(record + 17 + 4 * axis), axis);
  }

 private:
  void encode_offset(ArithmeticEncoder& out, std::uint64_t before, std::uint64_t offset, std::uint32_t size_before) {
    const std::uint64_t step = offset - before;
    const auto short_step = static_cast<std::int32_t>(step);
    const bool is_short = step == static_cast<std::uint64_t>(std::int64_t{short_step});
    const unsigned kind = step == 0 ? 0 : step == size_before ? 1 : is_short ? 2 : 3;
    out.symbol(kinds_[kind_before_], kind);
    kind_before_ = kind;
    if (kind == 2) step_.encode(out, std::exchange(step_before_, short_step), short_step);
    if (kind == 3) out.bits64(offset);
  }

  SymbolCounts index_{256};
  SymbolTables kinds_{4};
  IntegerEncoder step_{32, 1}, size_{32, 1}, place_{32, 1}, direction_{32, 3};
  unsigned kind_before_ = 0;
  std::int32_t step_before_ = 0;
};

class ExtraBytesEncoder {
 public:
  explicit ExtraBytesEncoder(std::size_t count = 1) : models_(count) {}
  void encode(ArithmeticEncoder& out, const std::byte* before, const std::byte* record) {
    for (std::size_t i = 0; i < models_.size(); ++i)
      out.symbol(models_[i],
                 static_cast<std::uint8_t>(std::to_integer<int>(record[i]) - std::to_integer<int>(before[i])));
  }

 private:
  std::vector<SymbolCounts> models_;
};

}  // namespace stipple::test
