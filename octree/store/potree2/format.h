// Potree 2.0 on disk, as PotreeConverter 2 writes it and the Potree viewer reads it: metadata.json, hierarchy.bin,
// octree.bin.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"
#include "octree/store/tree_store.h"

namespace stipple::potree2 {

// hierarchy.bin: 22 bytes a node, little-endian, packed: type u8, child mask u8 (bit i: child x<<2|y<<1|z = i exists),
// points u32, byte offset u64, byte size u64. A piece lists its nodes breadth first. For a proxy, offset and size are
// those of the piece, in hierarchy.bin, that starts with this very node; otherwise of the points, in octree.bin.
// As PotreeConverter 2 writes it: the type of an inner node may be leaf (the mask decides), a node of 0 bytes has no
// points whatever its count says (potree issue 1125), and there may be pieces that nothing refers to.
inline constexpr std::size_t kRecordBytes = 22;

enum class NodeType : std::uint8_t { inner = 0, leaf = 1, proxy = 2 };

struct Record {
  NodeType type = NodeType::inner;
  std::uint8_t child_mask = 0;
  std::uint32_t points = 0;
  std::uint64_t byte_offset = 0;
  std::uint64_t byte_size = 0;
};

// DEFAULT and UNCOMPRESSED are two names for records of all attributes, one point after the other.
// BROTLI: each node is one brotli stream of columns in schema order. Position: 16 bytes a point, two u64 that
// interleave 16 bits each of x, y and z (x lowest), first the upper halves, then the lower; "rgb" and "rgba": one such
// u64 for three u16, 8 bytes a point. All other columns as they are. Source: Potree, src/modules/loader/2.0.
enum class Encoding { uncompressed, brotli };

// A BROTLI node that unpacks to more is refused: a few bytes could claim any size.
inline constexpr std::uint64_t kMaxUnpackedBytes = std::uint64_t{512} << 20;

// What a point of the attribute takes in an unpacked BROTLI node. The position takes kBrotliPositionBytes.
std::size_t brotli_bytes(const Attribute& attribute);
inline constexpr std::size_t kBrotliPositionBytes = 16;

// What a point takes in records: the position and all of the schema.
std::size_t record_bytes(const Schema& schema);

using stipple::AttributeRange;

struct Metadata {
  std::string name;
  std::string description;
  std::string projection;
  std::uint64_t points = 0;
  std::uint64_t first_piece_bytes = 0;  // hierarchy.firstChunkSize
  int step_size = 4;                    // hierarchy.stepSize: levels a piece
  int depth = 0;                        // hierarchy.depth
  Grid grid;                            // offset and scale; positions are int32 on it
  double spacing = 0.0;
  WorldBox cube;  // boundingBox: the root node's cell
  Encoding encoding = Encoding::uncompressed;
  Schema schema;                       // without "position", which comes first in every record
  std::vector<AttributeRange> ranges;  // of "position", in world units, then of each of schema
};

// metadata.json. parse throws Error naming `path`, the key and what is expected there.
Metadata parse_metadata(const std::string& text, const std::string& path);
std::string write_metadata(const Metadata& metadata);

// One record. `at` points to kRecordBytes bytes.
Record read_record(const std::byte* at);
void write_record(const Record& record, std::byte* at);

}  // namespace stipple::potree2
