#include "octree/read/las/las_format.h"

#include <string>
#include <utility>

namespace stipple::las {
namespace {

// Appends fields one behind the other.
class Layout {
 public:
  explicit Layout(std::size_t at) : at_(at) {}

  void whole(std::string name, ScalarType type, int components = 1, double scale = 1.0) {
    fields_.push_back({{std::move(name), type, components, scale, 0.0}, at_, 0, 0});
    at_ += fields_.back().attribute.bytes();
  }
  // The next `bits` bits of the byte that is being shared out, from the lowest up.
  void part(std::string name, int bits) {
    fields_.push_back({{std::move(name), ScalarType::u8, 1, 1.0, 0.0}, at_, bits, shift_});
    shift_ += bits;
    if (shift_ < 8) return;
    shift_ = 0;
    ++at_;
  }

  std::size_t size() const { return at_; }
  std::vector<Field> take() { return std::move(fields_); }

 private:
  std::size_t at_;
  int shift_ = 0;
  std::vector<Field> fields_;
};

constexpr std::size_t kPositionSize = 3 * sizeof(std::int32_t);
constexpr double kDegreesPerScanAngleStep = 0.006;  // table "Point Data Record Format 6"

// Bytes 12 to 19 of formats 0 to 5.
void append_legacy_core(Layout& layout) {
  layout.whole("intensity", ScalarType::u16);
  layout.part("return number", 3);
  layout.part("number of returns", 3);
  layout.part("scan direction flag", 1);
  layout.part("edge of flight line", 1);
  layout.part("classification", 5);
  layout.part("classification flags", 3);
  layout.whole("scan angle", ScalarType::i8);
  layout.whole("user data", ScalarType::u8);
  layout.whole("point source id", ScalarType::u16);
}

// Bytes 12 to 21 of formats 6 to 10.
void append_core(Layout& layout) {
  layout.whole("intensity", ScalarType::u16);
  layout.part("return number", 4);
  layout.part("number of returns", 4);
  layout.part("classification flags", 4);
  layout.part("scanner channel", 2);
  layout.part("scan direction flag", 1);
  layout.part("edge of flight line", 1);
  layout.whole("classification", ScalarType::u8);
  layout.whole("user data", ScalarType::u8);
  layout.whole("scan angle", ScalarType::i16, 1, kDegreesPerScanAngleStep);
  layout.whole("point source id", ScalarType::u16);
}

void append_waveform(Layout& layout) {
  layout.whole("wave packet descriptor index", ScalarType::u8);
  layout.whole("byte offset to waveform data", ScalarType::u64);
  layout.whole("waveform packet size", ScalarType::u32);
  layout.whole("return point waveform location", ScalarType::f32);
  layout.whole("x(t)", ScalarType::f32);
  layout.whole("y(t)", ScalarType::f32);
  layout.whole("z(t)", ScalarType::f32);
}

Layout layout_of(int format) {
  Layout layout(kPositionSize);
  if (format >= 6)
    append_core(layout);
  else
    append_legacy_core(layout);
  const bool has_time = format == 1 || format >= 3;
  const bool has_rgb = format == 2 || format == 3 || format == 5 || format == 7 || format == 8 || format == 10;
  const bool has_nir = format == 8 || format == 10;
  const bool has_waveform = format == 4 || format == 5 || format == 9 || format == 10;
  if (has_time) layout.whole("gps-time", ScalarType::f64);
  if (has_rgb) layout.whole("rgb", ScalarType::u16, 3);
  if (has_nir) layout.whole("nir", ScalarType::u16);
  if (has_waveform) append_waveform(layout);
  return layout;
}

}  // namespace

std::size_t record_size(int format) {
  return layout_of(format).size();
}

std::vector<Field> point_fields(int format) {
  return layout_of(format).take();
}

}  // namespace stipple::las
