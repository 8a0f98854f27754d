// What the LAS format says: where things stand in the header, the variable length records and the points. Reader and
// writer share it. All numbers are little endian. Source: ASPRS LAS 1.4 R15 and LAS 1.5 R00; tables by their titles.
#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "octree/cloud/attribute.h"

namespace stipple::las {

static_assert(std::endian::native == std::endian::little, "LAS numbers are copied as they stand in the file");

// Table "Public Header Block": byte offsets.
inline constexpr std::size_t kSignature = 0;               // char[4], "LASF"
inline constexpr std::size_t kGlobalEncoding = 6;          // u16
inline constexpr std::size_t kVersionMajor = 24;           // u8
inline constexpr std::size_t kVersionMinor = 25;           // u8
inline constexpr std::size_t kSystemIdentifier = 26;       // char[32]
inline constexpr std::size_t kGeneratingSoftware = 58;     // char[32]
inline constexpr std::size_t kHeaderSize = 94;             // u16
inline constexpr std::size_t kOffsetToPoints = 96;         // u32
inline constexpr std::size_t kVlrCount = 100;              // u32
inline constexpr std::size_t kPointFormat = 104;           // u8
inline constexpr std::size_t kRecordLength = 105;          // u16
inline constexpr std::size_t kLegacyPointCount = 107;      // u32
inline constexpr std::size_t kLegacyCountsByReturn = 111;  // u32[5]
inline constexpr std::size_t kScale = 131;                 // f64[3]
inline constexpr std::size_t kOffset = 155;                // f64[3]
inline constexpr std::size_t kBounds = 179;                // f64[6]: max x, min x, max y, min y, max z, min z
inline constexpr std::size_t kWaveformStart = 227;         // u64, since 1.3
inline constexpr std::size_t kEvlrStart = 235;             // u64, since 1.4
inline constexpr std::size_t kEvlrCount = 243;             // u32, since 1.4
inline constexpr std::size_t kPointCount = 247;            // u64, since 1.4
inline constexpr std::size_t kCountsByReturn = 255;        // u64[15], since 1.4

// LASzip marks a compressed file by setting this bit of the point format.
inline constexpr int kCompressed = 0x80;

// Bytes of the public header block of version 1.0, 1.1, ... 1.5.
inline constexpr std::array<std::size_t, 6> kHeaderSizes{227, 227, 227, 235, 375, 393};
// The highest point format that each version defines.
inline constexpr std::array<int, 6> kHighestFormats{1, 1, 3, 5, 10, 10};

// Tables "Variable Length Record Header" and "Extended Variable Length Record Header". Both begin with u16 reserved,
// char[16] user id, u16 record id; then the length of the body, u16 or u64.
inline constexpr std::size_t kVlrHeaderSize = 54;
inline constexpr std::size_t kEvlrHeaderSize = 60;
inline constexpr std::size_t kRecordUserId = 2;
inline constexpr std::size_t kRecordUserIdSize = 16;
inline constexpr std::size_t kRecordId = 18;
inline constexpr std::size_t kRecordBodyLength = 20;

// One attribute of a point and where it stands in the point's record.
struct Field {
  Attribute attribute;
  std::size_t offset = 0;  // bytes from the start of the record
  int bits = 0;            // 0: whole scalars. Else `bits` bits of the byte at `offset`, above the lowest `shift`
  int shift = 0;

  bool operator==(const Field&) const = default;
};

// Bytes of the part of a record that the specification defines. `format` is 0 to 10.
std::size_t record_size(int format);

// All fields but x, y, z (three i32 at the start) of tables "Point Data Record Format 0" to "... 10", in the order in
// which they stand. "classification flags" holds synthetic, key-point, withheld and, from format 6 on, overlap in bits
// 0 to 3. "scan angle" is in degrees once its scale is applied. `format` is 0 to 10.
std::vector<Field> point_fields(int format);

}  // namespace stipple::las
