// Rows of numbers in text.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "octree/read/table/point_table.h"
#include "octree/read/text/line_index.h"

namespace stipple {

// What stands in a row at one place.
struct TextValue {
  static constexpr std::size_t kSkipped = static_cast<std::size_t>(-1);

  std::size_t field = kSkipped;  // of the table
  int component = 0;
  bool list = false;  // a count, and as many numbers; always skipped
};

// A stretch of rows. A table has one, or several whose rows belong together number by number.
struct TextPart {
  std::uint64_t first_row = 0;  // in the index
  std::vector<TextValue> values;
};

// A line that is neither empty nor made of blanks.
bool has_content(std::string_view line);

// How values are told apart: by blanks, and by `delimiter`, too, unless that is kBlanksOnly. Two delimiters have an
// empty value between them, which is an error.
class TextCursor {
 public:
  static constexpr char kBlanksOnly = ' ';

  TextCursor(std::string_view line, char delimiter)
      : at_(line.data()), end_(line.data() + line.size()), delimiter_(delimiter) {
    skip_blanks();
  }

  bool at_end() const { return at_ == end_; }
  const char* at() const { return at_; }
  const char* end() const { return end_; }
  // Goes on to the next value from `after`, where this one ends. False when other characters follow.
  bool advance(const char* after) {
    at_ = after;
    if (at_ != end_ && !is_blank(*at_) && *at_ != delimiter_) return false;
    skip_blanks();
    if (delimiter_ != kBlanksOnly && at_ != end_ && *at_ == delimiter_) {
      ++at_;
      skip_blanks();
    }
    return true;
  }
  // Where the value here ends, whatever it is.
  const char* value_end() const {
    const char* p = at_;
    while (p != end_ && !is_blank(*p) && *p != delimiter_) ++p;
    return p;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r'; }
  void skip_blanks() {
    while (at_ != end_ && is_blank(*at_)) ++at_;
  }

  const char* at_;
  const char* end_;
  char delimiter_;
};

// Error "PATH: line N: WHAT".
[[noreturn]] void throw_at_line(std::string_view path, std::uint64_t line, std::string_view what);

class TextTable : public PointTable {
 public:
  // The rows of all parts must be there. `file` is what `index` reads.
  TextTable(std::shared_ptr<const InputFile> file, std::shared_ptr<const LineIndex> index,
            std::vector<TableField> fields, std::vector<TextPart> parts, std::uint64_t rows, char delimiter);

  const std::vector<TableField>& fields() const override { return fields_; }
  std::size_t blocks() const override { return begins_.size() - 1; }
  std::size_t rows(std::size_t block) const override {
    return static_cast<std::size_t>(begins_[block + 1] - begins_[block]);
  }
  // Every row is held to the number of values it has to have, wanted or not.
  void decode(std::size_t block, std::span<const std::size_t> fields, std::span<Column> columns,
              Buffer<std::byte>& scratch) const override;

 private:
  struct Target;

  void read_row(const TextRow& row, const TextPart& part, std::span<const Target> targets, std::size_t i) const;

  std::shared_ptr<const InputFile> file_;
  std::shared_ptr<const LineIndex> index_;
  std::vector<TableField> fields_;
  std::vector<TextPart> parts_;
  char delimiter_;
  std::vector<std::uint64_t> begins_;  // first row of each block, and one more with the total
};

}  // namespace stipple
