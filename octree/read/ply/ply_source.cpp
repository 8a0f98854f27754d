#include "octree/read/ply/ply_source.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <bit>
#include <utility>

#include "octree/core/error.h"
#include "octree/read/ply/ply_header.h"
#include "octree/read/ply/ply_walk.h"
#include "octree/read/table/row_table.h"
#include "octree/read/table/table_source.h"
#include "octree/read/text/text_table.h"

namespace stipple {
namespace {

using ply::Element;
using ply::Encoding;
using ply::Header;
using ply::Property;

constexpr std::string_view kDisplaz = "vertex_";
constexpr std::string_view kRemedy = "Copy or download it again, or write it anew from its source.";

// Which elements hold the points, and the fields that their properties are. A displaz element "vertex_NAME" is one
// field of several components, but for those that have names of their own elsewhere.
struct Vertices {
  std::vector<std::size_t> elements;
  std::vector<TableField> fields;
  // For each element and property: which field and component it is; lists are none.
  std::vector<std::vector<TextValue>> values;
};

class VertexFinder {
 public:
  explicit VertexFinder(const Header& header) : header_(header) {}

  Vertices find(const std::string& path) {
    for (std::size_t e = 0; e < header_.elements.size() && vertices_.elements.empty(); ++e)
      if (header_.elements[e].name == "vertex") add_standard(e);
    for (std::size_t e = 0; e < header_.elements.size() && !standard_; ++e)
      if (header_.elements[e].name.starts_with(kDisplaz)) add_displaz(e);
    if (vertices_.elements.empty()) {
      std::vector<std::string> names;
      for (const Element& element : header_.elements) names.push_back(element.name);
      throw file_error(
          path, 0,
          fmt::format("the header declares no element \"vertex\", which the points would be; it declares {}. "
                      "Convert the file to points.",
                      names.empty() ? "nothing" : fmt::to_string(fmt::join(names, ", "))));
    }
    return std::move(vertices_);
  }

 private:
  TextValue add_field(std::string name, ScalarType type, int components = 1) {
    // Text has more digits than a float keeps
    const bool text = header_.encoding == Encoding::ascii && is_coordinate(name);
    vertices_.fields.push_back({std::move(name), text ? ScalarType::f64 : type, components});
    return {vertices_.fields.size() - 1, 0, false};
  }

  void add_standard(std::size_t e) {
    standard_ = true;
    std::vector<TextValue> values;
    for (const Property& property : header_.elements[e].properties)
      values.push_back(property.length ? TextValue{TextValue::kSkipped, 0, true}
                                       : add_field(property.name, property.type));
    add(e, std::move(values));
  }

  void add_displaz(std::size_t e) {
    const Element& element = header_.elements[e];
    const std::string name = element.name.substr(kDisplaz.size());
    const auto same_type = [&](const Property& p) { return p.type == element.properties.front().type; };
    const bool array = element.properties.size() > 1 && !element.has_list() && name != "position" && name != "color" &&
                       name != "normal" && std::ranges::all_of(element.properties, same_type);
    std::vector<TextValue> values;
    if (array) {
      const TextValue first =
          add_field(name, element.properties.front().type, static_cast<int>(element.properties.size()));
      for (int c = 0; c < static_cast<int>(element.properties.size()); ++c) values.push_back({first.field, c, false});
    } else {
      for (const Property& property : element.properties)
        values.push_back(property.length ? TextValue{TextValue::kSkipped, 0, true}
                                         : add_field(name_of(name, property.name, element), property.type));
    }
    add(e, std::move(values));
  }

  static std::string name_of(const std::string& element, const std::string& property, const Element& all) {
    if (element == "position" || element == "color") return property;
    if (element == "normal") return "n" + property;
    return all.properties.size() == 1 ? element : element + "_" + property;
  }

  void add(std::size_t e, std::vector<TextValue> values) {
    vertices_.elements.push_back(e);
    vertices_.values.push_back(std::move(values));
  }

  const Header& header_;
  Vertices vertices_;
  bool standard_ = false;
};

void check_counts(const Header& header, const Vertices& vertices, const std::string& path) {
  const Element& first = header.elements[vertices.elements.front()];
  for (const std::size_t e : vertices.elements) {
    const Element& element = header.elements[e];
    if (element.count != first.count)
      throw file_error(path, element.stated_at,
                       fmt::format("element \"{}\" has {} rows, and \"{}\" has {}; as many were expected. {}",
                                   element.name, element.count, first.name, first.count, kRemedy));
  }
}

class BinaryPly {
 public:
  BinaryPly(std::shared_ptr<const InputFile> file, const Header& header)
      : file_(std::move(file)),
        header_(header),
        swap_((header.encoding == Encoding::little_endian) != (std::endian::native == std::endian::little)) {}

  std::unique_ptr<PointTable> table(const Vertices& vertices, std::vector<std::string>& warnings) {
    const std::size_t last = vertices.elements.back();
    for (std::size_t e = 0; e <= last; ++e) find_end(e);
    warn_of_rest(warnings);
    if (vertices.elements.size() == 1 && header_.elements[last].has_list())
      return std::make_unique<ListVertices>(file_, header_.elements[last], begins_[last], swap_);
    return row_table(vertices);
  }

 private:
  // Keeps the file open as long as the table.
  class ListVertices : public ply::ListTable {
   public:
    ListVertices(std::shared_ptr<const InputFile> file, const Element& element, std::uint64_t begin, bool swap)
        : ListTable(*file, element, begin, swap), file_(std::move(file)) {}

   private:
    std::shared_ptr<const InputFile> file_;
  };

  void find_end(std::size_t e) {
    const Element& element = header_.elements[e];
    const std::uint64_t begin = begins_.back();
    const std::uint64_t left = file_->size() - begin;
    const std::size_t stride = element.row_bytes();
    if (stride > 0 && element.count > left / stride)
      throw file_error(file_->path(), element.stated_at,
                       fmt::format("the header states {} rows of element \"{}\", of {} bytes or more, and from byte {} "
                                   "on the file has {} bytes, enough for {}. {}",
                                   element.count, element.name, stride, begin, left, left / stride, kRemedy));
    if (element.has_list())
      begins_.push_back(ply::walk_rows(*file_, element, begin, swap_, element.count + 1).end);
    else
      begins_.push_back(begin + element.count * stride);
  }

  // Only where all elements are known: lists behind the vertices are not walked.
  void warn_of_rest(std::vector<std::string>& warnings) const {
    if (begins_.size() != header_.elements.size() + 1 || begins_.back() == file_->size()) return;
    warnings.push_back(fmt::format("Behind the last row, at byte {}, the file has {} more bytes; they are not read.",
                                   begins_.back(), file_->size() - begins_.back()));
  }

  std::unique_ptr<PointTable> row_table(const Vertices& vertices) const {
    std::vector<RowPart> parts;
    std::vector<FieldPlace> fields(vertices.fields.size());
    for (std::size_t p = 0; p < vertices.elements.size(); ++p) {
      const Element& element = header_.elements[vertices.elements[p]];
      if (element.has_list())
        throw file_error(
            file_->path(), element.stated_at,
            fmt::format("element \"{}\" has a list, and numbers were expected. {}", element.name, kRemedy));
      parts.push_back({begins_[vertices.elements[p]], element.row_bytes()});
      std::size_t offset = 0;
      for (std::size_t v = 0; v < element.properties.size(); ++v) {
        const TextValue& value = vertices.values[p][v];
        if (value.component == 0) fields[value.field] = {vertices.fields[value.field], p, offset};
        offset += size_of(element.properties[v].type);
      }
    }
    ByteReader bytes = [file = file_](std::uint64_t offset, std::size_t size, Buffer<std::byte>& scratch) {
      scratch.resize(size);
      file->read_at(offset, scratch);
      return static_cast<const std::byte*>(scratch.data());
    };
    const std::uint64_t rows = header_.elements[vertices.elements.front()].count;
    return std::make_unique<RowTable>(std::move(bytes), std::move(parts), std::move(fields), rows, swap_);
  }

  std::shared_ptr<const InputFile> file_;
  const Header& header_;
  bool swap_;
  std::vector<std::uint64_t> begins_{header_.body};  // of the elements, as far as found
};

std::size_t count_values(std::string_view line) {
  std::size_t count = 0;
  for (TextCursor cursor(line, TextCursor::kBlanksOnly); !cursor.at_end(); ++count) cursor.advance(cursor.value_end());
  return count;
}

// A list at the end of a row is what writers declare and then forget. Where the first row ends before it, no row is
// expected to have it.
void forget_missing_list(const LineIndex& index, const Element& element, TextPart& part,
                         std::vector<std::string>& warnings) {
  if (element.count == 0 || !part.values.back().list) return;
  const auto is_list = [](const TextValue& value) { return value.list; };
  if (std::any_of(part.values.begin(), part.values.end() - 1, is_list)) return;
  std::size_t values = 0;
  Buffer<std::byte> scratch;
  index.for_each_row(part.first_row, 1, scratch, [&](const TextRow& row) { values = count_values(row.text); });
  if (values + 1 != part.values.size()) return;
  part.values.pop_back();
  warnings.push_back(fmt::format("The rows lack the list \"{}\", which the header declares; it would not be read.",
                                 element.properties.back().name));
}

std::unique_ptr<PointTable> ascii_table(std::shared_ptr<const InputFile> file, const Header& header,
                                        const Vertices& vertices, std::vector<std::string>& warnings) {
  auto index = std::make_shared<const LineIndex>(*file, LineIndex::Start{header.body, header.body_line, header.newline},
                                                 has_content);
  std::vector<TextPart> parts;
  std::uint64_t row = 0;
  std::size_t v = 0;
  for (std::size_t e = 0; e <= vertices.elements.back(); ++e) {
    const Element& element = header.elements[e];
    const bool has_points = e == vertices.elements[v];
    if (has_points) parts.push_back({row, vertices.values[v++]});
    if (element.properties.empty()) continue;
    if (element.count > index->rows() - row)
      throw_at_line(file->path(), header.body_line + index->lines(),
                    fmt::format("the file ends here, with {} of the {} rows that the header states for element \"{}\" "
                                "at byte {}. {}",
                                index->rows() - row, element.count, element.name, element.stated_at, kRemedy));
    if (has_points) forget_missing_list(*index, element, parts.back(), warnings);
    row += element.count;
  }
  if (vertices.elements.back() + 1 == header.elements.size()) {
    if (row == index->rows() && row > 0 && !index->ends_with_newline())
      warnings.push_back("The last line has no line end: should the file be cut off, its last number may be wrong.");
    if (row < index->rows())
      warnings.push_back(
          fmt::format("The file has {} more lines than the header states; they are not read.", index->rows() - row));
  }
  const std::uint64_t rows = header.elements[vertices.elements.front()].count;
  return std::make_unique<TextTable>(std::move(file), std::move(index), vertices.fields, std::move(parts), rows,
                                     TextCursor::kBlanksOnly);
}

std::string encoding_of(const Header& header, const Vertices& vertices) {
  if (header.encoding == Encoding::ascii) return "ascii";
  std::size_t bytes = 0;
  for (const std::size_t e : vertices.elements) bytes += header.elements[e].row_bytes();
  const bool lists = header.elements[vertices.elements.front()].has_list();
  return fmt::format("binary {}-endian, {} bytes a point{}",
                     header.encoding == Encoding::little_endian ? "little" : "big", bytes,
                     lists ? " and what is in its lists" : "");
}

}  // namespace

std::unique_ptr<PointSource> open_ply(const std::string& path) {
  const auto file = std::make_shared<const InputFile>(path);
  std::string start(static_cast<std::size_t>(std::min<std::uint64_t>(file->size(), ply::kLongestHeader)), '\0');
  file->read_at(0, std::as_writable_bytes(std::span(start)));
  const Header header = ply::parse_header(start, path);
  const Vertices vertices = VertexFinder(header).find(path);
  check_counts(header, vertices, path);
  SourceInfo info;
  info.path = path;
  info.format = "PLY";
  info.version = header.version;
  info.encoding = encoding_of(header, vertices);
  meaning_of(vertices.fields, path + ":");  // before a large file is gone through
  auto table = header.encoding == Encoding::ascii ? ascii_table(file, header, vertices, info.warnings)
                                                  : BinaryPly(file, header).table(vertices, info.warnings);
  return std::make_unique<TableSource>(std::move(table), std::move(info));
}

}  // namespace stipple
