// What a point carries beside its position: a schema of typed columns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "octree/core/buffer.h"

namespace stipple {

enum class ScalarType : std::uint8_t { u8, i8, u16, i16, u32, i32, u64, i64, f32, f64 };

// Bytes of one scalar: 1, 2, 4 or 8.
std::size_t size_of(ScalarType type);
// "uint8", "int8", ... "double", as Potree 2.0 spells them.
std::string_view name_of(ScalarType type);

// Names follow Potree 2.0 where it has one: "rgb", "intensity", "classification", "return number",
// "number of returns", "gps-time", "point source id", "user data", "scan angle".
struct Attribute {
  std::string name;
  ScalarType type = ScalarType::u8;
  int components = 1;  // scalars a point, 1 or more; rgb has 3
  double scale = 1.0;  // value = stored * scale + offset
  double offset = 0.0;

  std::size_t bytes() const { return size_of(type) * static_cast<std::size_t>(components); }
  bool operator==(const Attribute&) const = default;
};

using Schema = std::vector<Attribute>;

// Index of the attribute called `name`.
std::optional<std::size_t> find_attribute(const Schema& schema, std::string_view name);

// One attribute of many points, tightly packed: point i occupies bytes [i * attribute.bytes(), (i + 1) * ...).
struct Column {
  Attribute attribute;
  Buffer<std::byte> bytes;

  void resize(std::size_t points) { bytes.resize(points * attribute.bytes()); }
  std::size_t points() const { return bytes.size() / attribute.bytes(); }
  // All scalars, `components` a point. T must match attribute.type.
  template <class T>
  std::span<const T> as() const {
    return {reinterpret_cast<const T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
  template <class T>
  std::span<T> as() {
    return {reinterpret_cast<T*>(bytes.data()), bytes.size() / sizeof(T)};
  }
};

// Component `c` of point `i` as a double, scale and offset applied.
double value_at(const Column& column, std::size_t i, int c = 0);

}  // namespace stipple
