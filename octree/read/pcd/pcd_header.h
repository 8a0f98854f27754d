// The header of a PCD file.
// Source: "The PCD (Point Cloud Data) file format", Point Cloud Library documentation; and files as they are.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "octree/read/table/point_table.h"

namespace stipple::pcd {

enum class Encoding { ascii, binary, binary_compressed };

// A field's column or place in a row. Padding has a name "_" and no type that matters.
struct Field {
  TableField field;
  std::size_t bytes = 0;  // of all components
};

struct Header {
  Encoding encoding = Encoding::ascii;
  std::string version;  // "0.7", also for ".7"
  std::vector<Field> fields;
  std::uint64_t points = 0;
  std::uint64_t points_at = 0;  // byte offset of the line that states them
  std::uint64_t body = 0;       // byte offset
  std::uint64_t body_line = 1;  // number of its first line, counted from 1
  std::vector<std::string> warnings;

  std::size_t row_bytes() const;
};

// Longer ones are refused.
inline constexpr std::size_t kLongestHeader = std::size_t{1} << 20;

// Whether the first line that is no comment begins as a line of a PCD header does.
bool begins_pcd(std::string_view start);

// `start`: the first kLongestHeader bytes of the file, or all. COUNT, VIEWPOINT, WIDTH, HEIGHT or POINTS may be
// missing, the last three not all. Throws Error naming path and byte.
Header parse_header(std::string_view start, const std::string& path);

}  // namespace stipple::pcd
