#include "octree/read/las/las_records.h"

#include <algorithm>

#include "octree/read/las/las_format.h"

namespace stipple::las {
namespace {

Record record_at(const FileBytes& file, std::uint64_t at, std::uint64_t body, std::uint64_t length) {
  return {std::string(file.text(at + kRecordUserId, kRecordUserIdSize)), file.at<std::uint16_t>(at + kRecordId), body,
          length};
}

}  // namespace

std::vector<Record> read_vlrs(const FileBytes& file, const RecordArea& area, std::vector<std::string>& warnings) {
  std::vector<Record> records;
  std::uint64_t at = area.begin;
  for (std::uint64_t i = 0; i < area.count; ++i) {
    if (area.end - at < kVlrHeaderSize) {
      warnings.push_back(fmt::format(
          "The header (byte {}) states {} variable length records, but before the points there is room for only {}.",
          kVlrCount, area.count, i));
      return records;
    }
    const std::uint64_t length = file.at<std::uint16_t>(at + kRecordBodyLength);
    const std::uint64_t body = at + kVlrHeaderSize;
    if (length > area.end - body)
      throw file_error(file.path, at + kRecordBodyLength,
                       fmt::format("variable length record {} states {} bytes, which reach beyond byte {}, where the "
                                   "points are said to begin; at most {} were expected. The header is damaged; write "
                                   "the file anew from its source.",
                                   i + 1, length, area.end, area.end - body));
    records.push_back(record_at(file, at, body, length));
    at = body + length;
  }
  return records;
}

std::vector<Record> read_evlrs(const FileBytes& file, const RecordArea& area, std::vector<std::string>& warnings) {
  std::vector<Record> records;
  std::uint64_t at = area.begin;
  for (std::uint64_t i = 0; i < area.count; ++i) {
    const bool header_fits = at <= area.end && area.end - at >= kEvlrHeaderSize;
    const std::uint64_t length = header_fits ? file.at<std::uint64_t>(at + kRecordBodyLength) : 0;
    if (!header_fits || length > area.end - at - kEvlrHeaderSize) {
      warnings.push_back(fmt::format(
          "Extended variable length record {} of {}, at byte {}, reaches beyond the end of the file at byte "
          "{}; it and those behind it are not read.",
          i + 1, area.count, at, area.end));
      return records;
    }
    records.push_back(record_at(file, at, at + kEvlrHeaderSize, length));
    at += kEvlrHeaderSize + length;
  }
  return records;
}

const Record* find_record(std::span<const Record> records, std::string_view user_id, std::uint16_t id) {
  const auto found = std::ranges::find_if(records, [&](const Record& r) { return r.user_id == user_id && r.id == id; });
  return found == records.end() ? nullptr : &*found;
}

}  // namespace stipple::las
