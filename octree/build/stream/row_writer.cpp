#include "octree/build/stream/row_writer.h"

#include <algorithm>
#include <cstring>

#include "octree/build/stream/record.h"
#include "octree/cloud/merged_schema.h"

namespace stipple {
namespace {

// Points whose records stay in the first-level cache while column after column is added to them.
constexpr std::size_t kBlockPoints = 512;

// A constant size turns memcpy into one or two moves.
template <std::size_t kSize>
void scatter(const std::byte* in, std::size_t count, std::byte* out, std::size_t stride) {
  for (std::size_t i = 0; i < count; ++i) std::memcpy(out + i * stride, in + i * kSize, kSize);
}

void scatter(std::size_t size, const std::byte* in, std::size_t count, std::byte* out, std::size_t stride) {
  switch (size) {
    case 1:
      return scatter<1>(in, count, out, stride);
    case 2:
      return scatter<2>(in, count, out, stride);
    case 4:
      return scatter<4>(in, count, out, stride);
    case 6:
      return scatter<6>(in, count, out, stride);
    case 8:
      return scatter<8>(in, count, out, stride);
    case 12:
      return scatter<12>(in, count, out, stride);
    default:
      for (std::size_t i = 0; i < count; ++i) std::memcpy(out + i * stride, in + i * size, size);
  }
}

}  // namespace

RowWriter::RowWriter(const Schema& own, std::span<const std::size_t> places, const Schema& common,
                     const GridTransform& transform)
    : transform_(transform) {
  std::vector<std::size_t> offsets;
  record_bytes_ = kPositionBytes;
  for (const Attribute& attribute : common) {
    offsets.push_back(record_bytes_);
    record_bytes_ += attribute.bytes();
  }
  for (std::size_t a = 0; a < own.size(); ++a)
    targets_.push_back({places[a], offsets[places[a]], own[a] != common[places[a]], common[places[a]]});
  for (std::size_t c = 0; c < common.size(); ++c)
    if (std::ranges::find(places, c) == places.end()) missing_.push_back({c, offsets[c], false, common[c]});
}

void RowWriter::write(const PointBatch& batch, Buffer<std::byte>& records, AttributeStats& stats) const {
  const std::size_t count = batch.positions.size();
  records.resize(count * record_bytes_);
  std::vector<Column> made;
  made.reserve(targets_.size() + missing_.size());
  std::vector<std::pair<const Column*, std::size_t>> columns;  // and where they go
  for (std::size_t a = 0; a < targets_.size(); ++a) {
    const Target& target = targets_[a];
    const Column& column =
        target.convert ? made.emplace_back(converted(batch.columns[a], target.attribute)) : batch.columns[a];
    columns.emplace_back(&column, target.offset);
    stats.add(target.index, column);
  }
  for (const Target& target : missing_) {
    columns.emplace_back(&made.emplace_back(zeros(target.attribute, count)), target.offset);
    stats.add(target.index, made.back());
  }
  for (std::size_t first = 0; first < count; first += kBlockPoints) {
    const std::size_t points = std::min(kBlockPoints, count - first);
    std::byte* const out = records.data() + first * record_bytes_;
    if (transform_.identity()) {
      scatter<kPositionBytes>(reinterpret_cast<const std::byte*>(&batch.positions[first]), points, out, record_bytes_);
    } else {
      for (std::size_t i = 0; i < points; ++i) {
        const glm::ivec3 moved = transform_(batch.positions[first + i]);
        std::memcpy(out + i * record_bytes_, &moved, sizeof moved);
      }
    }
    for (const auto& [column, offset] : columns) {
      const std::size_t size = column->attribute.bytes();
      scatter(size, column->bytes.data() + first * size, points, out + offset, record_bytes_);
    }
  }
}

}  // namespace stipple
