#include "octree/read/text/text_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "octree/core/error.h"
#include "octree/read/text/number.h"

namespace stipple {
namespace {

constexpr std::size_t kQuoted = 40;  // characters of a bad value that an error shows

std::string quoted(const TextCursor& cursor) {
  const std::string_view value(cursor.at(), cursor.value_end());
  return fmt::format("\"{}\"{}", value.substr(0, kQuoted), value.size() > kQuoted ? "..." : "");
}

}  // namespace

// Where the values of a field go.
struct TextTable::Target {
  std::byte* out = nullptr;  // null: not asked for
  std::size_t stride = 0;
};

bool has_content(std::string_view line) {
  return std::ranges::any_of(line, [](char c) { return c != ' ' && c != '\t' && c != '\r'; });
}

void throw_at_line(std::string_view path, std::uint64_t line, std::string_view what) {
  throw Error(fmt::format("{}: line {}: {}", path, line, what));
}

TextTable::TextTable(std::shared_ptr<const InputFile> file, std::shared_ptr<const LineIndex> index,
                     std::vector<TableField> fields, std::vector<TextPart> parts, std::uint64_t rows, char delimiter)
    : file_(std::move(file)),
      index_(std::move(index)),
      fields_(std::move(fields)),
      parts_(std::move(parts)),
      delimiter_(delimiter),
      begins_{0} {
  // A block is what a chunk has of the first part
  const std::uint64_t first = parts_.front().first_row;
  for (std::size_t chunk = 0; chunk < index_->chunks() && begins_.back() < rows; ++chunk) {
    const std::uint64_t end = index_->first_row(chunk) + index_->rows_of(chunk);
    if (end > first + begins_.back()) begins_.push_back(std::min(end - first, rows));
  }
}

void TextTable::decode(std::size_t block, std::span<const std::size_t> fields, std::span<Column> columns,
                       Buffer<std::byte>& scratch) const {
  std::vector<Target> targets(fields_.size());
  for (std::size_t i = 0; i < fields.size(); ++i)
    targets[fields[i]] = {columns[i].bytes.data(), columns[i].attribute.bytes()};
  for (const TextPart& part : parts_) {
    const auto wanted = [&](const TextValue& value) {
      return value.field != TextValue::kSkipped && targets[value.field].out != nullptr;
    };
    if (std::ranges::none_of(part.values, wanted)) continue;
    std::size_t i = 0;
    index_->for_each_row(part.first_row + begins_[block], rows(block), scratch,
                         [&](const TextRow& row) { read_row(row, part, targets, i++); });
  }
}

void TextTable::read_row(const TextRow& row, const TextPart& part, std::span<const Target> targets,
                         std::size_t i) const {
  const std::string& path = file_->path();
  TextCursor cursor(row.text, delimiter_);
  const auto missing = [&](std::size_t values) {
    throw_at_line(path, row.line,
                  fmt::format("has {} values, and {} were expected. The file is damaged or cut off; write it anew from "
                              "its source.",
                              values, part.values.size()));
  };
  for (std::size_t v = 0; v < part.values.size(); ++v) {
    const TextValue& value = part.values[v];
    if (cursor.at_end()) missing(v);
    std::size_t skipped = 1;
    if (value.list) {
      double count = 0.0;
      const char* const after = parse_number(cursor.at(), cursor.end(), count);
      if (!after || !(count >= 0.0) || count > static_cast<double>(row.text.size()))
        throw_at_line(path, row.line,
                      fmt::format("{} was found where the length of a list was expected", quoted(cursor)));
      skipped += static_cast<std::size_t>(count);
    } else if (value.field != TextValue::kSkipped && targets[value.field].out) {
      const Target& target = targets[value.field];
      const ScalarType type = fields_[value.field].type;
      const char* const after =
          parse_as(type, cursor.at(), cursor.end(),
                   target.out + i * target.stride + static_cast<std::size_t>(value.component) * size_of(type));
      if (!after || after != cursor.value_end())
        throw_at_line(path, row.line,
                      fmt::format("{} was found where the value of \"{}\" was expected, of type {}", quoted(cursor),
                                  fields_[value.field].name, name_of(type)));
    }
    for (std::size_t s = 0; s < skipped; ++s) {
      if (cursor.at_end()) missing(v);
      cursor.advance(cursor.value_end());
    }
  }
  if (!cursor.at_end())
    throw_at_line(
        path, row.line,
        fmt::format("has more than the {} values that were expected, beginning with {}. The lines and what is "
                    "said about them do not fit together.",
                    part.values.size(), quoted(cursor)));
}

}  // namespace stipple
