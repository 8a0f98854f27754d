// How the points of a LAZ file are compressed: the record "laszip encoded".
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "octree/read/las/las_header.h"

namespace stipple::laz {

// The user id and record id of that record.
inline constexpr std::string_view kUserId = "laszip encoded";
inline constexpr std::uint16_t kRecordId = 22204;

enum class Compressor : std::uint16_t { pointwise = 1, chunked = 2, layered = 3 };

enum class ItemType : std::uint16_t {
  bytes = 0,
  point10 = 6,
  gps_time11 = 7,
  rgb12 = 8,
  wave_packet13 = 9,
  point14 = 10,
  rgb14 = 11,
  rgb_nir14 = 12,
  wave_packet14 = 13,
  bytes14 = 14,
};

// A part of a point that is compressed by itself.
struct Item {
  ItemType type = ItemType::bytes;
  std::size_t size = 0;    // bytes of a record
  std::size_t offset = 0;  // from the start of the record
};

// Chunks of this many points have any number; the table of chunks says how many.
inline constexpr std::uint32_t kVariableChunks = 0xFFFFFFFFu;

struct Format {
  Compressor compressor = Compressor::chunked;
  std::uint32_t chunk_size = 0;  // points; kVariableChunks. Pointwise: without meaning
  int version = 0;               // of the items, all the same: 1 or 2; layered 3 or 4
  std::vector<Item> items;       // side by side, record_length bytes in all
  std::size_t record_length = 0;

  // The first item of a type; null when there is none.
  const Item* find(ItemType type) const;
};

// `body` stands at byte `offset` of the file `path`. Throws Error naming the byte, what was found and expected when the
// record is too short, when compressor, coder, an item or its version are none that is read, or when the items are not
// those of the header's point format and record length.
Format parse_format(std::span<const std::byte> body, std::uint64_t offset, const las::Header& header,
                    std::string_view path);

// The format of a file whose header says that it is compressed. Throws Error as above and when there is no such record.
Format read_format(std::span<const std::byte> file, const las::Header& header, std::string_view path);

}  // namespace stipple::laz
