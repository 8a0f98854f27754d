#include <bit>
#include <cstring>

#include "octree/store/potree2/format.h"

namespace stipple::potree2 {
namespace {

static_assert(std::endian::native == std::endian::little, "records are copied as they stand in the file");

constexpr std::size_t kType = 0;
constexpr std::size_t kChildMask = 1;
constexpr std::size_t kPoints = 2;
constexpr std::size_t kByteOffset = 6;
constexpr std::size_t kByteSize = 14;

}  // namespace

Record read_record(const std::byte* at) {
  Record record;
  record.type = static_cast<NodeType>(at[kType]);
  record.child_mask = std::to_integer<std::uint8_t>(at[kChildMask]);
  std::memcpy(&record.points, at + kPoints, sizeof record.points);
  std::memcpy(&record.byte_offset, at + kByteOffset, sizeof record.byte_offset);
  std::memcpy(&record.byte_size, at + kByteSize, sizeof record.byte_size);
  return record;
}

void write_record(const Record& record, std::byte* at) {
  at[kType] = static_cast<std::byte>(record.type);
  at[kChildMask] = static_cast<std::byte>(record.child_mask);
  std::memcpy(at + kPoints, &record.points, sizeof record.points);
  std::memcpy(at + kByteOffset, &record.byte_offset, sizeof record.byte_offset);
  std::memcpy(at + kByteSize, &record.byte_size, sizeof record.byte_size);
}

}  // namespace stipple::potree2
