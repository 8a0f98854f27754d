// The items of a point from the writer's side, version 1: what writers made until 2011. Source: LASzip specification,
// "POINT10", "GPSTIME11", "RGB12" and "BYTE", version 1.
#pragma once

#include "tests/read/laz_item_encoders.h"

namespace stipple::test {

class Point10EncoderV1 {
 public:
  explicit Point10EncoderV1(const std::byte* first) : last_(first) {}

  void encode(ArithmeticEncoder& out, const std::byte* record) {
    const PointFields p(record);
    const std::int32_t dx = difference(p.x, last_.x), dy = difference(p.y, last_.y);
    dx_.encode(out, median(x_steps_), dx);
    dy_.encode(out, median(y_steps_), dy, std::min(dx_.correction_class(), 19u));
    const unsigned mean = (dx_.correction_class() + dy_.correction_class()) / 2;
    z_.encode(out, last_.z, p.z, std::min(mean, 19u));
    const unsigned changed = (p.intensity != last_.intensity) << 5 | (p.flags != last_.flags) << 4 |
                             (p.classification != last_.classification) << 3 | (p.angle != last_.angle) << 2 |
                             (p.user_data != last_.user_data) << 1 | (p.source != last_.source);
    out.symbol(changed_, changed);
    if (changed & 32) intensity_.encode(out, last_.intensity, p.intensity);
    if (changed & 16) out.symbol(flags_[last_.flags], p.flags);
    if (changed & 8) out.symbol(classes_[last_.classification], p.classification);
    if (changed & 4) angle_.encode(out, last_.angle, p.angle, mean < 3);
    if (changed & 2) out.symbol(user_data_[last_.user_data], p.user_data);
    if (changed & 1) source_.encode(out, last_.source, p.source);
    last_ = p;
    x_steps_[oldest_] = dx;
    y_steps_[oldest_] = dy;
    oldest_ = (oldest_ + 1) % 3;
  }

 private:
  using Steps = std::array<std::int32_t, 3>;
  static std::int32_t median(Steps steps) {
    std::ranges::sort(steps);
    return steps[1];
  }

  PointFields last_;
  Steps x_steps_{}, y_steps_{};  // of the last three points
  std::size_t oldest_ = 0;
  SymbolCounts changed_{64};
  SymbolTables flags_{256}, classes_{256}, user_data_{256};
  IntegerEncoder intensity_{16, 1}, source_{16, 1}, angle_{8, 2}, dx_{32, 1}, dy_{32, 20}, z_{32, 20};
};

class GpsTimeEncoderV1 {
 public:
  explicit GpsTimeEncoderV1(std::uint64_t first) : last_(first) {}

  void encode(ArithmeticEncoder& out, std::uint64_t time) {
    const auto far = static_cast<std::int64_t>(time - last_);
    const auto step = static_cast<std::int32_t>(far);
    last_ = time;
    if (far == 0) return code(out, 0, 511);
    if (far != step) {
      code(out, 2, 510);
      return out.bits64(time);
    }
    if (step_ != 0) return encode_step(out, step);
    out.symbol(starts_, 1);
    differences_.encode(out, 0, step, 0);
    step_ = step;
  }

 private:
  void code(ArithmeticEncoder& out, unsigned start, unsigned multiple) {
    step_ == 0 ? out.symbol(starts_, start) : out.symbol(multiples_, multiple);
  }

  void encode_step(ArithmeticEncoder& out, std::int32_t step) {
    const int times = static_cast<int>(std::clamp(std::round(double{1} * step / step_), 0.0, 509.0));
    out.symbol(multiples_, static_cast<std::uint32_t>(times));
    const auto expected =
        times == 0 ? step_ / 4
                   : static_cast<std::int32_t>(static_cast<std::uint32_t>(times) * static_cast<std::uint32_t>(step_));
    const unsigned context = times == 0 ? 2 : times == 1 ? 1 : times < 10 ? 3 : times < 50 ? 4 : 5;
    differences_.encode(out, expected, step, context);
    if (times == 1) extremes_ = 0;
    const bool extreme = (times == 0 || times == 509) && ++extremes_ > 3;
    if (extreme) extremes_ = 0;
    if (extreme || times == 1) step_ = step;
  }

  std::uint64_t last_;
  std::int32_t step_ = 0;
  unsigned extremes_ = 0;
  SymbolCounts multiples_{512}, starts_{3};
  IntegerEncoder differences_{32, 6};
};

class RgbEncoderV1 {
 public:
  void encode(ArithmeticEncoder& out, const std::byte* before, const std::byte* record) {
    unsigned changed = 0;
    for (unsigned i = 0; i < 6; ++i) changed |= (record[i] != before[i]) << i;
    out.symbol(changed_, changed);
    for (unsigned i = 0; i < 6; ++i)
      if (changed >> i & 1u)
        bytes_.encode(out, std::to_integer<std::int32_t>(before[i]), std::to_integer<std::int32_t>(record[i]), i);
  }

 private:
  SymbolCounts changed_{64};
  IntegerEncoder bytes_{8, 6};
};

class ExtraBytesEncoderV1 {
 public:
  explicit ExtraBytesEncoderV1(std::size_t count) : count_(count), bytes_(8, static_cast<unsigned>(count)) {}
  void encode(ArithmeticEncoder& out, const std::byte* before, const std::byte* record) {
    for (unsigned i = 0; i < count_; ++i)
      bytes_.encode(out, std::to_integer<std::int32_t>(before[i]), std::to_integer<std::int32_t>(record[i]), i);
  }

 private:
  std::size_t count_;
  IntegerEncoder bytes_;
};

}  // namespace stipple::test
