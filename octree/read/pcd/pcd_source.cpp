#include "octree/read/pcd/pcd_source.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "octree/core/error.h"
#include "octree/read/pcd/lzf.h"
#include "octree/read/pcd/pcd_header.h"
#include "octree/read/table/row_table.h"
#include "octree/read/table/table_source.h"
#include "octree/read/text/text_table.h"

namespace stipple {
namespace {

using pcd::Encoding;
using pcd::Field;
using pcd::Header;

constexpr bool kSwap = std::endian::native != std::endian::little;
constexpr std::string_view kRemedy = "Copy or download it again, or write it anew from its source.";

bool is_padding(const Field& field) {
  return field.field.name == "_";
}

std::unique_ptr<PointTable> binary_table(std::shared_ptr<const InputFile> file, const Header& header,
                                         std::vector<std::string>& warnings) {
  const std::size_t stride = header.row_bytes();
  const std::uint64_t left = file->size() - header.body;
  if (header.points > left / stride)
    throw file_error(file->path(), header.points_at,
                     fmt::format("the header states {} points of {} bytes, and from byte {} on the file has {} bytes, "
                                 "enough for {}. {}",
                                 header.points, stride, header.body, left, left / stride, kRemedy));
  if (left - header.points * stride >= stride)
    warnings.push_back(fmt::format("Behind the last point, at byte {}, the file has {} more bytes; they are not read.",
                                   header.body + header.points * stride, left - header.points * stride));
  std::vector<FieldPlace> fields;
  std::size_t offset = 0;
  for (const Field& field : header.fields) {
    if (!is_padding(field)) fields.push_back({field.field, 0, offset});
    offset += field.bytes;
  }
  ByteReader bytes = [file](std::uint64_t at, std::size_t size, Buffer<std::byte>& scratch) {
    scratch.resize(size);
    file->read_at(at, scratch);
    return static_cast<const std::byte*>(scratch.data());
  };
  return std::make_unique<RowTable>(std::move(bytes), std::vector<RowPart>{{header.body, stride}}, std::move(fields),
                                    header.points, kSwap);
}

std::uint32_t read_u32(const InputFile& file, std::uint64_t at) {
  std::array<unsigned char, 4> bytes{};
  file.read_at(at, std::as_writable_bytes(std::span(bytes)));
  return std::uint32_t{bytes[0]} | std::uint32_t{bytes[1]} << 8 | std::uint32_t{bytes[2]} << 16 |
         std::uint32_t{bytes[3]} << 24;
}

// Column by column.
Buffer<std::byte> unpack(const InputFile& file, const Header& header) {
  constexpr std::uint64_t kSizes = 8;  // two numbers: bytes packed and unpacked
  const std::uint64_t left = file.size() - header.body;
  if (left < kSizes && header.points == 0) return {};
  if (left < kSizes)
    throw file_error(file.path(), header.body,
                     fmt::format("the file ends here, and two sizes were expected. {}", kRemedy));
  const std::uint64_t packed = read_u32(file, header.body);
  const std::uint64_t unpacked = read_u32(file, header.body + 4);
  const std::size_t stride = header.row_bytes();
  if (packed > left - kSizes)
    throw file_error(file.path(), header.body,
                     fmt::format("{} packed bytes are stated, and {} follow. {}", packed, left - kSizes, kRemedy));
  if (header.points > unpacked / stride || header.points * stride != unpacked || unpacked > packed * kMostLzfGrowth)
    throw file_error(file.path(), header.body + 4,
                     fmt::format("{} bytes are said to be packed into {}, and {} points of {} bytes were expected. {}",
                                 unpacked, packed, header.points, stride, kRemedy));
  Buffer<std::byte> from(static_cast<std::size_t>(packed));
  file.read_at(header.body + kSizes, from);
  Buffer<std::byte> to(static_cast<std::size_t>(unpacked));
  const LzfResult result = decode_lzf(from, to);
  if (!result.good)
    throw file_error(
        file.path(), header.body + kSizes + result.read,
        fmt::format("the packed points are damaged: {} of {} bytes came out. {}", result.written, unpacked, kRemedy));
  return to;
}

std::unique_ptr<PointTable> compressed_table(const InputFile& file, const Header& header) {
  const auto columns = std::make_shared<const Buffer<std::byte>>(unpack(file, header));
  std::vector<RowPart> parts;
  std::vector<FieldPlace> fields;
  std::uint64_t begin = 0;
  for (const Field& field : header.fields) {
    if (!is_padding(field)) {
      fields.push_back({field.field, parts.size(), 0});
      parts.push_back({begin, field.bytes});
    }
    begin += field.bytes * header.points;
  }
  ByteReader bytes = [columns](std::uint64_t at, std::size_t, Buffer<std::byte>&) { return columns->data() + at; };
  return std::make_unique<RowTable>(std::move(bytes), std::move(parts), std::move(fields), header.points, kSwap);
}

std::unique_ptr<PointTable> ascii_table(std::shared_ptr<const InputFile> file, const Header& header,
                                        std::vector<std::string>& warnings) {
  auto index =
      std::make_shared<const LineIndex>(*file, LineIndex::Start{header.body, header.body_line, '\n'}, has_content);
  if (index->rows() < header.points)
    throw_at_line(file->path(), header.body_line + index->lines(),
                  fmt::format("the file ends here, with {} of the {} points that the header states at byte {}. {}",
                              index->rows(), header.points, header.points_at, kRemedy));
  if (index->rows() > header.points)
    warnings.push_back(fmt::format("The file has {} more lines than the header states; they are not read.",
                                   index->rows() - header.points));
  else if (header.points > 0 && !index->ends_with_newline())
    warnings.push_back("The last line has no line end: should the file be cut off, its last number may be wrong.");

  std::vector<TableField> fields;
  TextPart part;
  for (const Field& field : header.fields) {
    const bool padding = is_padding(field);
    if (field.bytes == 0) continue;
    for (int c = 0; c < field.field.components; ++c)
      part.values.push_back({padding ? TextValue::kSkipped : fields.size(), c, false});
    if (padding) continue;
    fields.push_back(field.field);
    if (is_coordinate(field.field.name)) fields.back().type = ScalarType::f64;  // text has more digits than a float
  }
  return std::make_unique<TextTable>(std::move(file), std::move(index), std::move(fields), std::vector{part},
                                     header.points, ',');
}

std::string encoding_of(const Header& header) {
  switch (header.encoding) {
    case Encoding::ascii:
      return "ascii";
    case Encoding::binary:
      return fmt::format("binary, {} bytes a point", header.row_bytes());
    case Encoding::binary_compressed:
      return fmt::format("binary_compressed, {} bytes a point before", header.row_bytes());
  }
  return {};
}

std::vector<TableField> named_fields(const Header& header) {
  std::vector<TableField> fields;
  for (const Field& field : header.fields) fields.push_back(field.field);
  return fields;
}

}  // namespace

std::unique_ptr<PointSource> open_pcd(const std::string& path) {
  const auto file = std::make_shared<const InputFile>(path);
  std::string start(static_cast<std::size_t>(std::min<std::uint64_t>(file->size(), pcd::kLongestHeader)), '\0');
  file->read_at(0, std::as_writable_bytes(std::span(start)));
  const Header header = pcd::parse_header(start, path);
  meaning_of(named_fields(header), path + ":");  // before a large file is gone through
  SourceInfo info;
  info.path = path;
  info.format = "PCD";
  info.version = header.version;
  info.encoding = encoding_of(header);
  info.warnings = header.warnings;
  std::unique_ptr<PointTable> table;
  if (header.encoding == Encoding::ascii)
    table = ascii_table(file, header, info.warnings);
  else if (header.encoding == Encoding::binary)
    table = binary_table(file, header, info.warnings);
  else
    table = compressed_table(*file, header);
  return std::make_unique<TableSource>(std::move(table), std::move(info));
}

}  // namespace stipple
