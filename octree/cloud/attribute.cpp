#include "octree/cloud/attribute.h"

#include <algorithm>
#include <cstring>

namespace stipple {
namespace {

template <class T>
double load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return static_cast<double>(value);
}

double load(ScalarType type, const std::byte* at) {
  switch (type) {
    case ScalarType::u8:
      return load<std::uint8_t>(at);
    case ScalarType::i8:
      return load<std::int8_t>(at);
    case ScalarType::u16:
      return load<std::uint16_t>(at);
    case ScalarType::i16:
      return load<std::int16_t>(at);
    case ScalarType::u32:
      return load<std::uint32_t>(at);
    case ScalarType::i32:
      return load<std::int32_t>(at);
    case ScalarType::u64:
      return load<std::uint64_t>(at);
    case ScalarType::i64:
      return load<std::int64_t>(at);
    case ScalarType::f32:
      return load<float>(at);
    case ScalarType::f64:
      return load<double>(at);
  }
  return 0.0;
}

}  // namespace

std::size_t size_of(ScalarType type) {
  switch (type) {
    case ScalarType::u8:
    case ScalarType::i8:
      return 1;
    case ScalarType::u16:
    case ScalarType::i16:
      return 2;
    case ScalarType::u32:
    case ScalarType::i32:
    case ScalarType::f32:
      return 4;
    case ScalarType::u64:
    case ScalarType::i64:
    case ScalarType::f64:
      return 8;
  }
  return 0;
}

std::string_view name_of(ScalarType type) {
  static constexpr std::string_view kNames[] = {"uint8", "int8",   "uint16", "int16", "uint32",
                                                "int32", "uint64", "int64",  "float", "double"};
  return kNames[static_cast<std::size_t>(type)];
}

std::optional<std::size_t> find_attribute(const Schema& schema, std::string_view name) {
  const auto found = std::ranges::find(schema, name, &Attribute::name);
  if (found == schema.end()) return std::nullopt;
  return static_cast<std::size_t>(found - schema.begin());
}

double value_at(const Column& column, std::size_t i, int c) {
  const Attribute& a = column.attribute;
  const std::byte* at = column.bytes.data() + i * a.bytes() + static_cast<std::size_t>(c) * size_of(a.type);
  return load(a.type, at) * a.scale + a.offset;
}

}  // namespace stipple
