// The header of a PLY file.
// Source: G. Turk, "The PLY Polygon File Format" (1994), and the spellings that files really have.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "octree/cloud/attribute.h"

namespace stipple::ply {

enum class Encoding { ascii, little_endian, big_endian };

struct Property {
  std::string name;
  ScalarType type = ScalarType::f32;
  std::optional<ScalarType> length;  // of a list: the type of its count
};

struct Element {
  std::string name;
  std::uint64_t count = 0;
  std::vector<Property> properties;
  std::uint64_t stated_at = 0;  // byte offset of its line in the header

  bool has_list() const;
  // Bytes a row of a binary file has at least: all of them when there is no list.
  std::size_t row_bytes() const;
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::string version;
  std::vector<Element> elements;
  std::uint64_t body = 0;       // byte offset
  std::uint64_t body_line = 1;  // number of its first line, counted from 1
  char newline = '\n';          // '\r' where the lines end with that alone
};

// Longer ones are refused.
inline constexpr std::size_t kLongestHeader = std::size_t{1} << 20;

bool begins_ply(std::string_view start);

// `start`: the first kLongestHeader bytes of the file, or all. Throws Error naming path and byte.
Header parse_header(std::string_view start, const std::string& path);

}  // namespace stipple::ply
