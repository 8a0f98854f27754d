#include "octree/read/las/las_records.h"

#include "octree/read/las/las_format.h"

namespace stipple::las {
namespace {

constexpr std::uint16_t kExtraBytesRecord = 4;  // LAS 1.4 R15, "Extra Bytes"

bool describes_extra_bytes(const FileBytes& file, std::uint64_t record) {
  return file.at<std::uint16_t>(record + kRecordId) == kExtraBytesRecord &&
         file.text(record + kRecordUserId, kRecordUserIdSize) == "LASF_Spec";
}

}  // namespace

std::optional<std::span<const std::byte>> find_extra_bytes_vlr(const FileBytes& file, const RecordArea& area,
                                                               std::vector<std::string>& warnings) {
  std::optional<std::span<const std::byte>> found;
  std::uint64_t at = area.begin;
  for (std::uint64_t i = 0; i < area.count; ++i) {
    if (area.end - at < kVlrHeaderSize) {
      warnings.push_back(fmt::format(
          "The header (byte {}) states {} variable length records, but before the points there is room for only {}.",
          kVlrCount, area.count, i));
      return found;
    }
    const std::uint64_t length = file.at<std::uint16_t>(at + kRecordBodyLength);
    const std::uint64_t body = at + kVlrHeaderSize;
    if (length > area.end - body)
      throw file_error(file.path, at + kRecordBodyLength,
                       fmt::format("variable length record {} states {} bytes, which reach beyond byte {}, where the "
                                   "points are said to begin; at most {} were expected. The header is damaged; write "
                                   "the file anew from its source.",
                                   i + 1, length, area.end, area.end - body));
    if (!found && describes_extra_bytes(file, at)) found = file.range(body, length);
    at = body + length;
  }
  return found;
}

std::optional<std::span<const std::byte>> find_extra_bytes_evlr(const FileBytes& file, const RecordArea& area,
                                                                std::vector<std::string>& warnings) {
  std::optional<std::span<const std::byte>> found;
  std::uint64_t at = area.begin;
  for (std::uint64_t i = 0; i < area.count; ++i) {
    const bool header_fits = at <= area.end && area.end - at >= kEvlrHeaderSize;
    const std::uint64_t length = header_fits ? file.at<std::uint64_t>(at + kRecordBodyLength) : 0;
    if (!header_fits || length > area.end - at - kEvlrHeaderSize) {
      warnings.push_back(fmt::format(
          "Extended variable length record {} of {}, at byte {}, reaches beyond the end of the file at byte "
          "{}; it and those behind it are not read.",
          i + 1, area.count, at, area.end));
      return found;
    }
    if (!found && describes_extra_bytes(file, at)) found = file.range(at + kEvlrHeaderSize, length);
    at += kEvlrHeaderSize + length;
  }
  return found;
}

}  // namespace stipple::las
