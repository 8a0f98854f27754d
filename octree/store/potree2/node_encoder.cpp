#include "octree/store/potree2/node_encoder.h"

#include <brotli/encode.h>
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstdint>
#include <cstring>

#include "octree/build/morton.h"
#include "octree/core/error.h"
#include "octree/store/potree2/format.h"

namespace stipple::potree2 {
namespace {

// PotreeConverter's choice, too: from 5 on the encoder looks for matches across the whole window; 9 takes five times
// as long and saves 2 %.
constexpr int kQuality = 6;

// Bit i of x, y and z to bits 3i, 3i + 1 and 3i + 2.
std::uint64_t interleave(std::uint32_t x, std::uint32_t y, std::uint32_t z) {
  return spread_bits(x) | spread_bits(y) << 1 | spread_bits(z) << 2;
}

void put_positions(std::span<const std::byte> records, std::size_t stride, std::byte* to) {
  constexpr std::uint32_t kLower = 0xFFFF;
  for (std::size_t at = 0; at < records.size(); at += stride) {
    std::uint32_t p[3];
    std::memcpy(p, records.data() + at, sizeof p);
    const std::uint64_t codes[2]{interleave(p[0] >> 16, p[1] >> 16, p[2] >> 16),
                                 interleave(p[0] & kLower, p[1] & kLower, p[2] & kLower)};
    std::memcpy(to, codes, sizeof codes);
    to += sizeof codes;
  }
}

void put_colours(std::span<const std::byte> records, std::size_t stride, std::size_t offset, std::byte* to) {
  for (std::size_t at = offset; at < records.size(); at += stride) {
    std::uint16_t rgb[3];
    std::memcpy(rgb, records.data() + at, sizeof rgb);
    const std::uint64_t code = interleave(rgb[0], rgb[1], rgb[2]);
    std::memcpy(to, &code, sizeof code);
    to += sizeof code;
  }
}

Buffer<std::byte> columns_of(std::span<const std::byte> records, const Schema& schema) {
  const std::size_t stride = record_bytes(schema);
  const std::size_t points = records.size() / stride;
  std::size_t a_point = kBrotliPositionBytes;
  for (const Attribute& attribute : schema) a_point += brotli_bytes(attribute);
  if (points * a_point > kMaxUnpackedBytes)
    throw Error(
        fmt::format("a node of {} points would take {} bytes before packing, and at most {} are read again. "
                    "Build with --encoding DEFAULT.",
                    points, points * a_point, kMaxUnpackedBytes));
  Buffer<std::byte> columns(points * a_point);
  std::byte* to = columns.data();
  put_positions(records, stride, to);
  to += points * kBrotliPositionBytes;
  std::size_t offset = sizeof(glm::ivec3);
  for (const Attribute& attribute : schema) {
    const std::size_t bytes = attribute.bytes();
    if (brotli_bytes(attribute) != bytes) {
      put_colours(records, stride, offset, to);
    } else {
      for (std::size_t i = 0; i < points; ++i) std::memcpy(to + i * bytes, records.data() + i * stride + offset, bytes);
    }
    to += points * brotli_bytes(attribute);
    offset += bytes;
  }
  return columns;
}

}  // namespace

Buffer<std::byte> encode_brotli(std::span<const std::byte> records, const Schema& schema) {
  const Buffer<std::byte> columns = columns_of(records, schema);
  // A window beyond the data would only take memory
  const int window = std::clamp(static_cast<int>(std::bit_width(columns.size())), BROTLI_MIN_WINDOW_BITS, 22);
  Buffer<std::byte> packed(BrotliEncoderMaxCompressedSize(columns.size()));
  std::size_t size = packed.size();
  if (BrotliEncoderCompress(kQuality, window, BROTLI_MODE_GENERIC, columns.size(),
                            reinterpret_cast<const std::uint8_t*>(columns.data()), &size,
                            reinterpret_cast<std::uint8_t*>(packed.data())) != BROTLI_TRUE)
    throw Error(fmt::format("brotli could not pack {} bytes; it ran out of memory.", columns.size()));
  packed.resize(size);
  return packed;
}

void encode_brotli(PackedNodes& packed, const Schema& schema) {
  Buffer<std::byte> bytes;
  std::span<const std::byte> records = packed.bytes;
  for (PackedNodes::PackedNode& node : packed.nodes) {
    const Buffer<std::byte> encoded = encode_brotli(records.first(node.bytes), schema);
    records = records.subspan(node.bytes);
    node.bytes = encoded.size();
    bytes.insert(bytes.end(), encoded.begin(), encoded.end());
  }
  packed.bytes = std::move(bytes);
}

}  // namespace stipple::potree2
