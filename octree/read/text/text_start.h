// The begin of a plain text file: comments, a count, names of columns, the first row.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace stipple {

struct TextStart {
  std::uint64_t body = 0;       // byte offset of the first row
  std::uint64_t body_line = 1;  // its number
  char newline = '\n';
  char delimiter = 0;              // ',' or ';' beside blanks, or none
  std::size_t columns = 0;         // numbers in the first row
  std::vector<std::string> names;  // of the columns; empty when no line has as many words
  std::uint64_t names_line = 0;
  std::optional<std::uint64_t> count;  // a number that stands alone before the points, as in PTS
  bool grid = false;                   // two such lines: a PTX file
};

// How many bytes read_start() wants to see.
inline constexpr std::size_t kTextStart = std::size_t{64} << 10;

// Empty lines and lines that begin with "//" or "#" are no rows.
bool is_text_row(std::string_view line);

// Nothing when the bytes are no text, or no row of three numbers comes after comments, a count and a line of words.
std::optional<TextStart> read_start(std::string_view start);

}  // namespace stipple
