#include "octree/read/table/row_table.h"

#include <algorithm>
#include <utility>

#include "octree/read/gather.h"

namespace stipple {
namespace {

// Columns of so many rows stay in the second-level cache until the points are made of them.
constexpr std::size_t kMaxBlockRows = 16'384;
// Long rows make smaller blocks, so that memory stays bounded.
constexpr std::size_t kMaxBlockBytes = std::size_t{4} << 20;

}  // namespace

RowTable::RowTable(ByteReader bytes, std::vector<RowPart> parts, std::vector<FieldPlace> fields, std::uint64_t rows,
                   bool swap)
    : bytes_(std::move(bytes)), parts_(std::move(parts)), places_(std::move(fields)), rows_(rows), swap_(swap) {
  std::size_t longest = 1;
  for (const RowPart& part : parts_) longest = std::max(longest, part.stride);
  block_rows_ = std::clamp<std::size_t>(kMaxBlockBytes / longest, 1, kMaxBlockRows);
  for (const FieldPlace& place : places_) fields_.push_back(place.field);
}

std::size_t RowTable::blocks() const {
  return static_cast<std::size_t>((rows_ + block_rows_ - 1) / block_rows_);
}

std::size_t RowTable::rows(std::size_t block) const {
  return static_cast<std::size_t>(std::min<std::uint64_t>(block_rows_, rows_ - block * block_rows_));
}

void RowTable::decode(std::size_t block, std::span<const std::size_t> fields, std::span<Column> columns,
                      Buffer<std::byte>& scratch) const {
  const std::size_t count = rows(block);
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const auto in_part = [&](std::size_t field) { return places_[field].part == p; };
    if (std::ranges::none_of(fields, in_part)) continue;
    const RowPart& part = parts_[p];
    const std::byte* const bytes = bytes_(part.begin + block * block_rows_ * part.stride, count * part.stride, scratch);
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (!in_part(fields[i])) continue;
      const FieldPlace& place = places_[fields[i]];
      Column& column = columns[i];
      gather(column.attribute.bytes(), bytes + place.offset, part.stride, count, column.bytes.data());
      const std::size_t scalar = size_of(place.field.type);
      if (swap_) swap_bytes(scalar, column.bytes.data(), column.bytes.size() / scalar);
    }
  }
}

}  // namespace stipple
