#include "octree/read/laz/chunk_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <utility>

#include "octree/read/las/las_decode.h"

namespace stipple::laz {
namespace {

// Records of a block stay in the nearest cache until they are columns.
constexpr std::size_t kBlockPoints = 1024;

constexpr std::uint64_t kTrustedPointsPerByte = 8;
constexpr std::uint64_t kTrustedPoints = 1'000'000;

}  // namespace

bool is_plausible(std::uint64_t points, std::uint64_t bytes) {
  return points <= kTrustedPoints || points / kTrustedPointsPerByte <= bytes;
}

ChunkReader::ChunkReader(const InputFile& file, const Format& format, std::vector<las::Field> fields)
    : file_(file),
      record_length_(format.record_length),
      fields_(std::move(fields)),
      decoder_(make_point_decoder(file, format, fields_)),
      records_(kBlockPoints * format.record_length) {}

void ChunkReader::begin(const Chunk& chunk) {
  chunk_ = chunk;
  decoder_->begin(chunk);
}

void ChunkReader::make_room(std::size_t count, PointBatch& batch) const {
  batch.positions.resize(count);
  batch.columns.resize(fields_.size());
  for (std::size_t c = 0; c < fields_.size(); ++c) {
    batch.columns[c].attribute = fields_[c].attribute;
    batch.columns[c].resize(count);
  }
}

// For the next block of a batch of `count` points, of which `first` are there.
std::span<std::byte> ChunkReader::block_records(std::size_t first, std::size_t count) {
  return std::span(records_).first(std::min(kBlockPoints, count - std::min(first, count)) * record_length_);
}

void ChunkReader::take_block(std::span<const std::byte> records, std::size_t first, PointBatch& batch) const {
  const std::size_t count = records.size() / record_length_;
  if (count == 0) return;
  las::decode_positions(records, record_length_, std::span(batch.positions).subspan(first, count));
  for (std::size_t c = 0; c < fields_.size(); ++c) {
    const std::size_t each = fields_[c].attribute.bytes();
    las::decode_field(fields_[c], records, record_length_,
                      std::span(batch.columns[c].bytes).subspan(first * each, count * each));
  }
}

void ChunkReader::read(std::size_t count, PointBatch& batch) {
  make_room(count, batch);
  for (std::size_t first = 0; first < count; first += kBlockPoints) {
    const std::span<std::byte> records = block_records(first, count);
    decoder_->decode(records);
    take_block(records, first, batch);
  }
}

void ChunkReader::read_both(std::size_t count, PointBatch& batch, ChunkReader& other, std::size_t other_count,
                            PointBatch& other_batch) {
  make_room(count, batch);
  other.make_room(other_count, other_batch);
  for (std::size_t first = 0; first < std::max(count, other_count); first += kBlockPoints) {
    const std::span<std::byte> records = block_records(first, count);
    const std::span<std::byte> other_records = other.block_records(first, other_count);
    decoder_->decode_both(records, *other.decoder_, other_records);
    take_block(records, first, batch);
    other.take_block(other_records, first, other_batch);
  }
}

void ChunkReader::read_chunk(const Chunk& chunk, PointBatch& batch) {
  begin(chunk);
  if (!is_plausible(chunk.points, chunk.bytes)) {
    decode_through();
    begin(chunk);
  }
  read(static_cast<std::size_t>(chunk.points), batch);
  check_end();
}

void ChunkReader::decode_through() {
  for (std::uint64_t left = chunk_.points; left > 0;) {
    const std::uint64_t block = std::min<std::uint64_t>(kBlockPoints, left);
    decoder_->decode(std::span(records_).first(static_cast<std::size_t>(block) * record_length_));
    left -= block;
  }
}

void ChunkReader::check_end() {
  const std::uint64_t expected = chunk_.begin + chunk_.bytes;
  const std::uint64_t found = decoder_->end();
  if (found == expected || chunk_.points == 1) return;
  throw chunk_error(file_.path(), std::min(found, expected), chunk_,
                    fmt::format("is damaged: its points end at byte {}, and {} was expected.", found, expected));
}

}  // namespace stipple::laz
