#include "octree/store/rows.h"

#include <cstdint>
#include <cstring>

namespace stipple {
namespace {

// One component of every row to every `stride_to` bytes. A constant size turns memcpy into a load and a store.
template <std::size_t kBytes>
void copy_component(const std::byte* from, std::size_t stride_from, std::size_t points, std::byte* to,
                    std::size_t stride_to) {
  for (std::size_t i = 0; i < points; ++i) std::memcpy(to + i * stride_to, from + i * stride_from, kBytes);
}

void widen_component(const std::byte* from, std::size_t stride_from, std::size_t points, std::byte* to,
                     std::size_t stride_to) {
  for (std::size_t i = 0; i < points; ++i) {
    const std::uint16_t value = std::to_integer<std::uint16_t>(from[i * stride_from]);
    std::memcpy(to + i * stride_to, &value, sizeof value);
  }
}

void decode_column(std::span<const std::byte> rows, std::size_t row, const RowField& field, Column& column) {
  const std::size_t points = column.points();
  if (points == 0) return;
  const std::size_t scalar = size_of(field.attribute.type);
  const std::size_t all = field.attribute.bytes();
  for (std::size_t c = 0; c < field.offsets.size(); ++c) {
    const std::byte* from = rows.data() + field.offsets[c];
    std::byte* to = column.bytes.data() + c * scalar;
    if (field.widened)
      widen_component(from, row, points, to, all);
    else if (scalar == 1)
      copy_component<1>(from, row, points, to, all);
    else if (scalar == 2)
      copy_component<2>(from, row, points, to, all);
    else if (scalar == 4)
      copy_component<4>(from, row, points, to, all);
    else
      copy_component<8>(from, row, points, to, all);
  }
}

}  // namespace

Schema RowLayout::schema() const {
  Schema schema;
  for (const RowField& field : fields) schema.push_back(field.attribute);
  return schema;
}

void decode_columns(std::span<const std::byte> rows, const RowLayout& layout, std::span<const std::size_t> attributes,
                    PointBatch& batch) {
  batch.columns.resize(attributes.size());
  for (std::size_t c = 0; c < attributes.size(); ++c) {
    const RowField& field = layout.fields.at(attributes[c]);
    batch.columns[c].attribute = field.attribute;
    batch.columns[c].resize(rows.size() / layout.bytes);
    decode_column(rows, layout.bytes, field, batch.columns[c]);
  }
}

}  // namespace stipple
