#include "octree/read/text/text_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <atomic>
#include <utility>

#include "octree/core/error.h"
#include "octree/read/table/table_source.h"
#include "octree/read/text/number.h"
#include "octree/read/text/text_columns.h"
#include "octree/read/text/text_table.h"

namespace stipple {
namespace {

// Reads all numbers of a row.
void read_row(const std::string& path, const TextStart& start, const TextRow& text, std::vector<double>& row) {
  row.clear();
  for (TextCursor cursor(text.text, start.delimiter); !cursor.at_end();) {
    double value = 0.0;
    const std::string_view word(cursor.at(), cursor.value_end());
    const char* const after = parse_number(cursor.at(), cursor.end(), value);
    if (!after || !cursor.advance(after))
      throw_at_line(path, text.line,
                    fmt::format("\"{}\" was found where a number was expected, as column {}. Take the line out, or put "
                                "\"#\" before it.",
                                word.substr(0, 40), row.size() + 1));
    row.push_back(value);
  }
  if (row.size() != start.columns)
    throw_at_line(path, text.line,
                  fmt::format("has {} numbers, and {} were expected, as in line {}. Take the line out, or put \"#\" "
                              "before it.",
                              row.size(), start.columns, start.body_line));
}

TextFacts facts_of(const std::string& path, const TextStart& start, const LineIndex& index) {
  struct Thread {
    TextFacts facts;
    std::vector<double> row;
    Buffer<std::byte> scratch;
  };
  tbb::enumerable_thread_specific<Thread> threads([&] { return Thread{TextFacts(start.columns), {}, {}}; });
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, index.chunks(), [&](std::size_t) {
    const std::size_t chunk = next.fetch_add(1);
    Thread& thread = threads.local();
    index.for_each_row(index.first_row(chunk), index.rows_of(chunk), thread.scratch, [&](const TextRow& text) {
      read_row(path, start, text, thread.row);
      thread.facts.add(thread.row);
    });
  });
  TextFacts facts(start.columns);
  for (const Thread& thread : threads) facts.merge(thread.facts);
  return facts;
}

std::string encoding_of(const TextStart& start, const std::vector<TableField>& fields) {
  std::vector<std::string> names;
  for (const TableField& field : fields) names.push_back(field.name.starts_with("column ") ? "?" : field.name);
  const std::string_view separated =
      start.delimiter == ',' ? "commas" : (start.delimiter == ';' ? "semicolons" : "blanks");
  const std::string source =
      start.names.empty() ? "guessed from the numbers" : fmt::format("named by line {}", start.names_line);
  return fmt::format("columns {}, separated by {}; {}", fmt::join(names, " "), separated, source);
}

void warn(const TextStart& start, const LineIndex& index, std::vector<std::string>& warnings) {
  if (start.count && *start.count != index.rows())
    warnings.push_back(fmt::format("The file states {} points before the first, and has {}{}.", *start.count,
                                   index.rows(), *start.count > index.rows() ? "; it may be cut off" : ""));
  else if (!start.count && !index.ends_with_newline())
    warnings.push_back("The last line has no line end: should the file be cut off, its last number may be wrong.");
}

}  // namespace

std::unique_ptr<PointSource> open_text(const std::string& path, const TextStart& start) {
  if (start.grid)
    throw Error(
        fmt::format("{}: begins with two lines of one number each, as PTX files do, which are not read. Convert "
                    "it to PTS or PLY.",
                    path));
  const auto file = std::make_shared<const InputFile>(path);
  const auto index = std::make_shared<const LineIndex>(
      *file, LineIndex::Start{start.body, start.body_line, start.newline}, is_text_row);
  std::vector<TableField> fields = columns_of(facts_of(path, start, *index), start.names);
  SourceInfo info;
  info.path = path;
  info.format = "text";
  info.encoding = encoding_of(start, fields);
  warn(start, *index, info.warnings);
  TextPart part;
  for (std::size_t c = 0; c < fields.size(); ++c) part.values.push_back({c, 0, false});
  auto table = std::make_unique<TextTable>(file, index, std::move(fields), std::vector{std::move(part)}, index->rows(),
                                           start.delimiter);
  return std::make_unique<TableSource>(std::move(table), std::move(info));
}

}  // namespace stipple
