#include "octree/read/las/las_header.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include "octree/read/las/las_bytes.h"
#include "octree/read/las/las_extra_bytes.h"

namespace stipple::las {
namespace {

constexpr int kHighestFormat = 10;
constexpr std::uint16_t kExtraBytesRecord = 4;  // LAS 1.4 R15, "Extra Bytes"

void parse_version(const FileBytes& file, Header& header) {
  const std::span<const std::byte> signature =
      file.bytes.first(std::min<std::size_t>(file.bytes.size(), std::string_view("LASF").size()));
  if (std::string_view(reinterpret_cast<const char*>(signature.data()), signature.size()) != "LASF")
    throw file_error(file.path, kSignature,
                     "the file does not begin with the four characters LASF: it is no LAS file. Check the path.");
  const int major = file.at<std::uint8_t>(kVersionMajor);
  const int minor = file.at<std::uint8_t>(kVersionMinor);
  if (major != 1 || minor >= static_cast<int>(kHeaderSizes.size()))
    throw file_error(file.path, kVersionMajor,
                     fmt::format("LAS version {}.{} was found, and 1.0 to 1.{} are read. Convert the file to LAS 1.4.",
                                 major, minor, kHeaderSizes.size() - 1));
  header.version_minor = minor;
}

// Returns the size of the header, which is where the variable length records begin.
std::size_t parse_sizes(const FileBytes& file, Header& header) {
  const std::size_t expected = kHeaderSizes[static_cast<std::size_t>(header.version_minor)];
  file.range(0, expected);
  const std::size_t stated = file.at<std::uint16_t>(kHeaderSize);
  if (stated < expected)
    throw file_error(file.path, kHeaderSize,
                     fmt::format("a header of {} bytes is stated, and LAS 1.{} has at least {}. The header is damaged; "
                                 "write the file anew from its source.",
                                 stated, header.version_minor, expected));
  header.points_begin = file.at<std::uint32_t>(kOffsetToPoints);
  if (header.points_begin < stated || header.points_begin > file.size())
    throw file_error(
        file.path, kOffsetToPoints,
        fmt::format("the points are said to begin at byte {}, and a place between the end of the header at "
                    "byte {} and the end of the file at byte {} was expected. The file is damaged or cut "
                    "off; copy or download it again.",
                    header.points_begin, stated, file.size()));
  return stated;
}

void parse_point_format(const FileBytes& file, Header& header) {
  const int stated = file.at<std::uint8_t>(kPointFormat);
  const int format = stated & ~kCompressed;
  header.compressed = stated != format;
  if (format > kHighestFormat)
    throw file_error(file.path, kPointFormat,
                     fmt::format("point format {} was found, and 0 to {} are read. Convert the file to one of these.",
                                 format, kHighestFormat));
  header.point_format = format;
  header.record_length = file.at<std::uint16_t>(kRecordLength);
  if (header.record_length < record_size(format))
    throw file_error(file.path, kRecordLength,
                     fmt::format("{} bytes a point are stated, and point format {} has at least {}. The header is "
                                 "damaged; write the file anew from its source.",
                                 header.record_length, format, record_size(format)));
  if (format > kHighestFormats[static_cast<std::size_t>(header.version_minor)])
    header.warnings.push_back(fmt::format(
        "Point format {} is none of LAS 1.{}; it is read as later versions define it.", format, header.version_minor));
}

void parse_point_count(const FileBytes& file, Header& header) {
  const std::uint32_t legacy = file.at<std::uint32_t>(kLegacyPointCount);
  header.point_count = legacy;
  if (header.version_minor < 4) return;

  header.point_count = file.at<std::uint64_t>(kPointCount);
  if (legacy == 0 || legacy == header.point_count) return;
  // Above 32 bits the legacy count should be zero; some writers leave the low bits or the largest number there.
  if (header.point_count <= std::numeric_limits<std::uint32_t>::max())
    throw file_error(file.path, kLegacyPointCount,
                     fmt::format("{} points are stated here and {} at byte {}; equal numbers, or zero here, were "
                                 "expected. The header is damaged; write the file anew from its source.",
                                 legacy, header.point_count, kPointCount));
  header.warnings.push_back(fmt::format("The header states {} points at byte {} and {} at byte {}; the latter is used.",
                                        legacy, kLegacyPointCount, header.point_count, kPointCount));
}

void check_points_are_there(const FileBytes& file, const Header& header) {
  const std::uint64_t whole = (file.size() - header.points_begin) / header.record_length;
  if (header.point_count <= whole) return;
  throw file_error(
      file.path, file.size(),
      fmt::format("the file ends here, with {} of the {} points that the header states ({} bytes each, from "
                  "byte {} on). It was cut off; copy or download it again.",
                  whole, header.point_count, header.record_length, header.points_begin));
}

void parse_grid(const FileBytes& file, Header& header) {
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t step = static_cast<std::size_t>(axis) * sizeof(double);
    const double scale = file.at<double>(kScale + step);
    const double offset = file.at<double>(kOffset + step);
    if (!std::isfinite(scale) || scale <= 0.0)
      throw file_error(
          file.path, kScale + step,
          fmt::format("the scale of {} is {}, and a number above zero was expected. The header is damaged; "
                      "write the file anew from its source.",
                      "xyz"[axis], scale));
    // Largest coordinate that an int32 can stand for
    const double reach = std::abs(offset) - scale * static_cast<double>(std::numeric_limits<std::int32_t>::min());
    if (!std::isfinite(reach))
      throw file_error(file.path, kOffset + step,
                       fmt::format("with an offset of {} and a scale of {}, {} is not finite, as was expected. The "
                                   "header is damaged; write the file anew from its source.",
                                   offset, scale, "xyz"[axis]));
    header.grid.scale[axis] = scale;
    header.grid.offset[axis] = offset;
  }
}

void parse_bounds(const FileBytes& file, Header& header) {
  if (header.point_count == 0) return;
  WorldBox box;
  for (int axis = 0; axis < 3; ++axis) {
    const std::size_t max = kBounds + 2 * static_cast<std::size_t>(axis) * sizeof(double);
    box.max[axis] = file.at<double>(max);
    box.min[axis] = file.at<double>(max + sizeof(double));
    if (!std::isfinite(box.min[axis]) || !std::isfinite(box.max[axis]) || box.min[axis] > box.max[axis]) {
      header.warnings.push_back(fmt::format("The header states bounds that are no box: {} from {} to {}, at byte {}.",
                                            "xyz"[axis], box.min[axis], box.max[axis], max));
      return;
    }
  }
  header.stated_bounds = box;
}

// All records, wherever they stand.
void parse_records(const FileBytes& file, std::size_t header_size, Header& header) {
  const RecordArea vlrs{header_size, header.points_begin, file.at<std::uint32_t>(kVlrCount)};
  header.records = read_vlrs(file, vlrs, header.warnings);
  if (header.version_minor < 4) return;

  const RecordArea evlrs{file.at<std::uint64_t>(kEvlrStart), file.size(), file.at<std::uint32_t>(kEvlrCount)};
  if (evlrs.count == 0) return;
  // Where compressed points end, only who decodes them knows
  const std::uint64_t points_end = header.compressed ? header.points_begin : header.points_end();
  if (evlrs.begin < points_end) {
    header.warnings.push_back(fmt::format(
        "The header (byte {}) states that extended variable length records begin at byte {}, before the end of the "
        "points at byte {}; they are not read.",
        kEvlrStart, evlrs.begin, points_end));
    return;
  }
  for (Record& record : read_evlrs(file, evlrs, header.warnings)) header.records.push_back(std::move(record));
}

void parse_fields(const FileBytes& file, Header& header) {
  header.fields = point_fields(header.point_format);
  std::optional<std::span<const std::byte>> description;
  if (const Record* record = find_record(header.records, "LASF_Spec", kExtraBytesRecord))
    description = file.range(record->begin, record->size);
  append_extra_bytes(description, record_size(header.point_format), header.record_length, header.fields,
                     header.warnings);
}

// Points that were appended without counting them, say.
void warn_of_unexplained_bytes(const FileBytes& file, Header& header) {
  const std::uint64_t begin = header.points_end();
  std::uint64_t end = file.size();
  const auto explain_from = [&](std::uint64_t place) {
    if (place >= begin) end = std::min(end, place);
  };
  if (header.version_minor >= 3) explain_from(file.at<std::uint64_t>(kWaveformStart));
  if (header.version_minor >= 4 && file.at<std::uint32_t>(kEvlrCount) > 0)
    explain_from(file.at<std::uint64_t>(kEvlrStart));
  if (end - begin < header.record_length) return;
  header.warnings.push_back(
      fmt::format("Behind the last of the {} points that the header states, from byte {} on, {} bytes follow that "
                  "nothing explains; they would hold {} more points and are not read.",
                  header.point_count, begin, end - begin, (end - begin) / header.record_length));
}

}  // namespace

Header parse_header(std::span<const std::byte> bytes, std::string_view path) {
  const FileBytes file{bytes, path};
  Header header;
  parse_version(file, header);
  const std::size_t header_size = parse_sizes(file, header);
  parse_point_format(file, header);
  parse_point_count(file, header);
  parse_grid(file, header);
  if (!header.compressed) check_points_are_there(file, header);
  parse_bounds(file, header);
  parse_records(file, header_size, header);
  parse_fields(file, header);
  if (!header.compressed) warn_of_unexplained_bytes(file, header);
  return header;
}

SourceInfo source_info(const Header& header, const std::string& path, std::string format) {
  SourceInfo info;
  info.path = path;
  info.format = std::move(format);
  info.version = fmt::format("1.{}", header.version_minor);
  info.encoding = fmt::format("point format {}, {} bytes a point", header.point_format, header.record_length);
  info.point_count = header.point_count;
  info.grid = header.grid;
  for (const Field& field : header.fields) info.schema.push_back(field.attribute);
  info.stated_bounds = header.stated_bounds;
  info.warnings = header.warnings;
  return info;
}

}  // namespace stipple::las
