#include "octree/store/potree2/node_points.h"

#include <brotli/decode.h>
#include <fmt/format.h>

#include <cstring>

#include "octree/build/morton.h"
#include "octree/core/error.h"
#include "octree/store/potree2/format.h"

namespace stipple::potree2 {
namespace {

template <std::size_t kBytes>
void gather(const std::byte* from, std::size_t stride, std::size_t points, std::byte* to) {
  for (std::size_t i = 0; i < points; ++i) std::memcpy(to + i * kBytes, from + i * stride, kBytes);
}

// Copies `bytes` of every `stride` bytes. Known sizes become single loads and stores.
void gather(const std::byte* from, std::size_t stride, std::size_t points, std::size_t bytes, std::byte* to) {
  switch (bytes) {
    case 1:
      return gather<1>(from, stride, points, to);
    case 2:
      return gather<2>(from, stride, points, to);
    case 4:
      return gather<4>(from, stride, points, to);
    case 6:
      return gather<6>(from, stride, points, to);
    case 8:
      return gather<8>(from, stride, points, to);
    default:
      for (std::size_t i = 0; i < points; ++i) std::memcpy(to + i * bytes, from + i * stride, bytes);
  }
}

void shape(PointBatch& batch, std::size_t points, const Schema& schema, std::span<const std::size_t> attributes) {
  batch.positions.resize(points);
  batch.columns.resize(attributes.size());
  for (std::size_t c = 0; c < attributes.size(); ++c) {
    batch.columns[c].attribute = schema.at(attributes[c]);
    batch.columns[c].resize(points);
  }
}

std::uint64_t load_code(const std::byte* at) {
  std::uint64_t code;
  std::memcpy(&code, at, sizeof code);
  return code;
}

// The three numbers of 16 bits in a code, the lowest bit of the first lowest.
glm::uvec3 separate(std::uint64_t code) {
  constexpr std::uint32_t kLower = 0xFFFF;
  return {gather_bits(code) & kLower, gather_bits(code >> 1) & kLower, gather_bits(code >> 2) & kLower};
}

void decode_positions(const std::byte* from, std::span<glm::ivec3> to) {
  for (glm::ivec3& position : to) {
    position = glm::ivec3(separate(load_code(from)) << 16u | separate(load_code(from + 8)));
    from += kBrotliPositionBytes;
  }
}

void decode_column(const std::byte* from, std::size_t points, Column& column) {
  const std::size_t bytes = brotli_bytes(column.attribute);
  if (bytes == column.attribute.bytes()) {
    std::memcpy(column.bytes.data(), from, column.bytes.size());
    return;
  }
  std::uint16_t* to = column.as<std::uint16_t>().data();
  for (std::size_t i = 0; i < points; ++i) {
    const glm::uvec3 rgb = separate(load_code(from + i * bytes));
    for (int c = 0; c < 3; ++c) *to++ = static_cast<std::uint16_t>(rgb[c]);
  }
}

Buffer<std::byte> unpack(std::span<const std::byte> packed, std::uint64_t bytes) {
  if (bytes > kMaxUnpackedBytes)
    throw Error(fmt::format("they would unpack to {} bytes, and at most {} are read", bytes, kMaxUnpackedBytes));
  Buffer<std::byte> unpacked(static_cast<std::size_t>(bytes));
  std::size_t size = unpacked.size();
  const BrotliDecoderResult result =
      BrotliDecoderDecompress(packed.size(), reinterpret_cast<const std::uint8_t*>(packed.data()), &size,
                              reinterpret_cast<std::uint8_t*>(unpacked.data()));
  if (result != BROTLI_DECODER_RESULT_SUCCESS || size != unpacked.size())
    throw Error(fmt::format("they are no brotli stream that unpacks to {} bytes", bytes));
  return unpacked;
}

}  // namespace

void decode_records(std::span<const std::byte> records, std::size_t points, const Schema& schema,
                    std::span<const std::size_t> attributes, PointBatch& batch) {
  const std::size_t stride = record_bytes(schema);
  shape(batch, points, schema, attributes);
  if (points == 0) return;  // no records may have no address
  gather(records.data(), stride, points, sizeof(glm::ivec3), reinterpret_cast<std::byte*>(batch.positions.data()));
  for (std::size_t c = 0; c < attributes.size(); ++c) {
    const std::size_t offset = record_bytes({schema.begin(), schema.begin() + attributes[c]});
    Column& column = batch.columns[c];
    gather(records.data() + offset, stride, points, column.attribute.bytes(), column.bytes.data());
  }
}

void decode_brotli(std::span<const std::byte> packed, std::size_t points, const Schema& schema,
                   std::span<const std::size_t> attributes, PointBatch& batch) {
  std::vector<std::size_t> begin{points * kBrotliPositionBytes};  // of each column of the schema; last: the end
  for (const Attribute& attribute : schema) begin.push_back(begin.back() + points * brotli_bytes(attribute));
  const Buffer<std::byte> unpacked = unpack(packed, begin.back());
  shape(batch, points, schema, attributes);
  decode_positions(unpacked.data(), batch.positions);
  for (std::size_t c = 0; c < attributes.size(); ++c)
    decode_column(unpacked.data() + begin[attributes[c]], points, batch.columns[c]);
}

}  // namespace stipple::potree2
