#include "octree/read/obj/obj_source.h"

#include <fmt/format.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <limits>
#include <utility>

#include "octree/core/error.h"
#include "octree/read/table/table_source.h"
#include "octree/read/text/number.h"
#include "octree/read/text/text_table.h"

namespace stipple {
namespace {

constexpr std::size_t kMostValues = 7;  // x y z w red green blue

bool is_blank(char c) {
  return c == ' ' || c == '\t';
}

std::string_view without_blanks(std::string_view line) {
  while (!line.empty() && is_blank(line.front())) line.remove_prefix(1);
  return line;
}

bool is_vertex(std::string_view line) {
  line = without_blanks(line);
  return line.size() > 1 && line[0] == 'v' && is_blank(line[1]);
}

// A comment at the end of a line is none of its values.
TextCursor values_of(std::string_view line) {
  line = without_blanks(line);
  return TextCursor(line.substr(1, line.find('#') - 1), TextCursor::kBlanksOnly);
}

std::size_t count_values(std::string_view line) {
  std::size_t count = 0;
  for (TextCursor cursor = values_of(line); !cursor.at_end(); ++count) cursor.advance(cursor.value_end());
  return count;
}

// x, y, z and, where any vertex has them, three colours; NaN for a vertex that has none.
class ObjTable : public PointTable {
 public:
  ObjTable(std::shared_ptr<const InputFile> file, std::shared_ptr<const LineIndex> index)
      : file_(std::move(file)), index_(std::move(index)) {
    for (const char* name : {"x", "y", "z"}) fields_.push_back({name, ScalarType::f64, 1});
    std::atomic<std::uint64_t> colored{0};
    std::atomic<bool> weighted{false};
    tbb::parallel_for(std::size_t{0}, index_->chunks(), [&](std::size_t chunk) {
      Buffer<std::byte> scratch;
      index_->for_each_row(index_->first_row(chunk), index_->rows_of(chunk), scratch, [&](const TextRow& row) {
        const std::size_t values = count_values(row.text);
        if (values < 3 || values == 5 || values > kMostValues)
          throw_at_line(file_->path(), row.line,
                        fmt::format("the vertex has {} values, and x y z [w] [red green blue] were expected. Write the "
                                    "file anew from its source.",
                                    values));
        if (values >= 6) ++colored;
        if (values == 4 || values == 7) weighted = true;
      });
    });
    colored_ = colored;
    weighted_ = weighted;
    if (colored_ > 0)
      for (const char* name : {"red", "green", "blue"}) fields_.push_back({name, ScalarType::f64, 1});
  }

  std::uint64_t colored() const { return colored_; }
  bool weighted() const { return weighted_; }

  const std::vector<TableField>& fields() const override { return fields_; }
  std::size_t blocks() const override { return index_->chunks(); }
  std::size_t rows(std::size_t block) const override { return index_->rows_of(block); }

  void decode(std::size_t block, std::span<const std::size_t> fields, std::span<Column> columns,
              Buffer<std::byte>& scratch) const override {
    std::size_t i = 0;
    index_->for_each_row(index_->first_row(block), rows(block), scratch, [&](const TextRow& row) {
      const std::array<double, 6> values = read(row);
      for (std::size_t f = 0; f < fields.size(); ++f) columns[f].as<double>()[i] = values[fields[f]];
      ++i;
    });
  }

 private:
  std::array<double, 6> read(const TextRow& row) const {
    std::array<double, kMostValues> found{};
    std::size_t count = 0;
    for (TextCursor cursor = values_of(row.text); !cursor.at_end() && count < found.size();) {
      const char* const after = parse_number(cursor.at(), cursor.end(), found[count++]);
      if (!after || !cursor.advance(after))
        throw_at_line(file_->path(), row.line,
                      fmt::format("value {} of the vertex is no number. Write the file anew from its source.", count));
    }
    constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
    const std::size_t color = count - 3;
    if (count < 6) return {found[0], found[1], found[2], kNone, kNone, kNone};
    return {found[0], found[1], found[2], found[color], found[color + 1], found[color + 2]};
  }

  std::shared_ptr<const InputFile> file_;
  std::shared_ptr<const LineIndex> index_;
  std::vector<TableField> fields_;
  std::uint64_t colored_ = 0;
  bool weighted_ = false;
};

}  // namespace

bool begins_obj(std::string_view start) {
  static constexpr std::string_view kKeywords[] = {"mtllib", "usemtl", "vn", "vt", "vp", "o", "g", "s"};
  static constexpr std::string_view kNumbered[] = {"v", "f", "l", "p"};
  while (!start.empty()) {
    const std::size_t end = std::min(start.find_first_of("\r\n"), start.size());
    const std::string_view line = without_blanks(start.substr(0, end));
    start.remove_prefix(std::min(end + 1, start.size()));
    if (line.empty() || line[0] == '#') continue;
    const std::size_t blank = line.find_first_of(" \t");
    const std::string_view word = line.substr(0, blank);
    if (blank == std::string_view::npos) return false;
    if (std::ranges::find(kKeywords, word) != std::end(kKeywords)) return true;
    if (std::ranges::find(kNumbered, word) == std::end(kNumbered)) return false;
    const std::string_view rest = without_blanks(line.substr(blank));
    double number = 0.0;
    return parse_number(rest.data(), rest.data() + rest.size(), number) != nullptr;
  }
  return false;
}

std::unique_ptr<PointSource> open_obj(const std::string& path) {
  const auto file = std::make_shared<const InputFile>(path);
  const auto index = std::make_shared<const LineIndex>(*file, LineIndex::Start{0, 1, newline_of(*file)}, is_vertex);
  auto table = std::make_unique<ObjTable>(file, index);
  SourceInfo info;
  info.path = path;
  info.format = "OBJ";
  info.encoding = table->colored() > 0 ? "text, vertices with colours" : "text, vertices";
  if (table->colored() > 0 && table->colored() < index->rows())
    info.warnings.push_back(fmt::format("{} of {} vertices have no colour; they are white.",
                                        index->rows() - table->colored(), index->rows()));
  if (index->rows() == 0) info.warnings.push_back("The file has no vertices.");
  if (table->weighted()) info.warnings.push_back("Vertices have a weight w beside x, y and z; it is not read.");
  if (index->rows() > 0 && !index->ends_with_newline())
    info.warnings.push_back("The last line has no line end: should the file be cut off, its last number may be wrong.");
  return std::make_unique<TableSource>(std::move(table), std::move(info));
}

}  // namespace stipple
