#include "octree/read/las/las_extra_bytes.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>
#include <unordered_map>
#include <utility>

#include "octree/read/las/las_bytes.h"

namespace stipple::las {
namespace {

// LAS 1.4 R15, table "Extra Bytes Descriptor": byte offsets. Options: what the other fields mean.
constexpr std::size_t kDescriptorSize = 192;
constexpr std::size_t kDataType = 2;  // u8
constexpr std::size_t kOptions = 3;   // u8; for type 0 the number of bytes
constexpr std::size_t kName = 4;      // char[32]
constexpr std::size_t kNameSize = 32;
constexpr std::size_t kScales = 112;   // f64[3]
constexpr std::size_t kOffsets = 136;  // f64[3]
constexpr int kHasScale = 1 << 3;
constexpr int kHasOffset = 1 << 4;

constexpr std::array kScalarTypes{ScalarType::u8,  ScalarType::i8,  ScalarType::u16, ScalarType::i16, ScalarType::u32,
                                  ScalarType::i32, ScalarType::u64, ScalarType::i64, ScalarType::f32, ScalarType::f64};
constexpr int kTypes = static_cast<int>(kScalarTypes.size());
constexpr int kMaxComponents = 3;

// Length of the UTF-8 sequence that `text` begins with, 0 when it begins with none. Overlong forms and surrogates
// (Unicode 15, table 3-7) are none.
std::size_t utf8_sequence(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const auto continues = [&](std::size_t i) { return (byte(i) & 0xC0u) == 0x80u; };
  const unsigned first = byte(0);
  if (first < 0x80) return 1;
  if (first >= 0xC2 && first < 0xE0) return continues(1) ? 2 : 0;
  if (first >= 0xE0 && first < 0xF0) {
    const bool overlong = first == 0xE0 && byte(1) < 0xA0;
    const bool surrogate = first == 0xED && byte(1) >= 0xA0;
    return continues(1) && continues(2) && !overlong && !surrogate ? 3 : 0;
  }
  if (first >= 0xF0 && first < 0xF5) {
    const bool overlong = first == 0xF0 && byte(1) < 0x90;
    const bool beyond = first == 0xF4 && byte(1) >= 0x90;
    return continues(1) && continues(2) && continues(3) && !overlong && !beyond ? 4 : 0;
  }
  return 0;
}

std::string printable(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    const std::size_t length = utf8_sequence(text);
    const bool control = length == 1 && (static_cast<unsigned char>(text[0]) < 0x20 || text[0] == 0x7F);
    if (length == 0 || control)
      result += '?';
    else
      result += text.substr(0, length);
    text.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return result;
}

// Hands out each name once.
class Names {
 public:
  explicit Names(const std::vector<Field>& taken) {
    for (const Field& field : taken) uses_.emplace(field.attribute.name, 1);
  }
  std::string unique(const std::string& wanted) {
    std::string name = wanted;
    while (uses_.contains(name)) name = fmt::format("{} {}", wanted, ++uses_[wanted]);
    uses_.emplace(name, 1);
    return name;
  }

 private:
  std::unordered_map<std::string, int> uses_;
};

struct Descriptor {
  std::string name;
  int data_type = 0;
  ScalarType scalar = ScalarType::u8;
  int components = 0;  // 0: no such type
  std::array<double, kMaxComponents> scale{1.0, 1.0, 1.0};
  std::array<double, kMaxComponents> offset{0.0, 0.0, 0.0};

  std::size_t bytes() const { return size_of(scalar) * static_cast<std::size_t>(components); }
  bool uniform() const {
    for (std::size_t c = 1; c < static_cast<std::size_t>(std::min(components, kMaxComponents)); ++c)
      if (scale[c] != scale[0] || offset[c] != offset[0]) return false;
    return true;
  }
};

Descriptor parse_descriptor(const FileBytes& bytes, std::size_t at, std::vector<std::string>& warnings) {
  Descriptor result;
  const int options = bytes.at<std::uint8_t>(at + kOptions);
  result.data_type = bytes.at<std::uint8_t>(at + kDataType);
  result.name = printable(bytes.text(at + kName, kNameSize));
  if (result.name.empty()) result.name = "extra bytes";
  if (result.data_type == 0) {
    result.components = options;
    return result;
  }
  if (result.data_type > kMaxComponents * kTypes) return result;
  result.scalar = kScalarTypes[static_cast<std::size_t>((result.data_type - 1) % kTypes)];
  result.components = 1 + (result.data_type - 1) / kTypes;

  bool usable = true;
  for (std::size_t c = 0; c < static_cast<std::size_t>(result.components); ++c) {
    if (options & kHasScale) result.scale[c] = bytes.at<double>(at + kScales + c * sizeof(double));
    if (options & kHasOffset) result.offset[c] = bytes.at<double>(at + kOffsets + c * sizeof(double));
    usable = usable && std::isfinite(result.scale[c]) && result.scale[c] != 0.0 && std::isfinite(result.offset[c]);
  }
  if (usable) return result;
  warnings.push_back(fmt::format(
      "Extra attribute \"{}\" states a scale of zero or a number that is not finite; its values are shown as stored.",
      result.name));
  result.scale.fill(1.0);
  result.offset.fill(0.0);
  return result;
}

void append_descriptor(const Descriptor& descriptor, std::size_t at, Names& names, std::vector<Field>& fields) {
  if (descriptor.uniform()) {
    Attribute attribute{names.unique(descriptor.name), descriptor.scalar, descriptor.components, descriptor.scale[0],
                        descriptor.offset[0]};
    fields.push_back({std::move(attribute), at});
    return;
  }
  for (std::size_t c = 0; c < static_cast<std::size_t>(descriptor.components); ++c) {
    Attribute attribute{names.unique(fmt::format("{}[{}]", descriptor.name, c)), descriptor.scalar, 1,
                        descriptor.scale[c], descriptor.offset[c]};
    fields.push_back({std::move(attribute), at + c * size_of(descriptor.scalar)});
  }
}

// Appends the described fields and returns where they end, or says why the description cannot be used and returns
// `begin` with nothing appended.
std::size_t append_described(std::span<const std::byte> description, std::size_t begin, std::size_t end,
                             std::vector<Field>& fields, std::vector<std::string>& warnings) {
  Names names(fields);
  const std::size_t before = fields.size();
  const FileBytes bytes{description, {}};
  const auto reject = [&](const std::string& why) {
    fields.resize(before);
    warnings.push_back(why + " The description of the extra bytes is not used; they are read as plain bytes.");
    return begin;
  };

  std::size_t at = begin;
  for (std::size_t place = 0; description.size() - place >= kDescriptorSize; place += kDescriptorSize) {
    const Descriptor descriptor = parse_descriptor(bytes, place, warnings);
    if (descriptor.components == 0) {
      if (descriptor.data_type == 0) continue;
      return reject(fmt::format("Extra attribute \"{}\" has data type {}, and 0 to {} exist.", descriptor.name,
                                descriptor.data_type, kMaxComponents * kTypes));
    }
    if (descriptor.bytes() > end - at)
      return reject(fmt::format("Extra attribute \"{}\" takes {} bytes, and {} of the record are left.",
                                descriptor.name, descriptor.bytes(), end - at));
    append_descriptor(descriptor, at, names, fields);
    at += descriptor.bytes();
  }
  if (const std::size_t rest = description.size() % kDescriptorSize; rest != 0)
    warnings.push_back(
        fmt::format("The description of the extra bytes ends with {} bytes that are no whole descriptor.", rest));
  return at;
}

}  // namespace

void append_extra_bytes(std::optional<std::span<const std::byte>> description, std::size_t begin, std::size_t end,
                        std::vector<Field>& fields, std::vector<std::string>& warnings) {
  if (description) begin = append_described(*description, begin, end, fields, warnings);
  if (begin == end) return;
  Attribute rest{Names(fields).unique("extra bytes"), ScalarType::u8, static_cast<int>(end - begin), 1.0, 0.0};
  fields.push_back({std::move(rest), begin});
}

}  // namespace stipple::las
