// Potree 2.0 on disk, as PotreeConverter 2 writes it and the Potree viewer reads it: metadata.json, hierarchy.bin,
// octree.bin.
#pragma once

#include <cstdint>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "octree/cloud/attribute.h"
#include "octree/cloud/grid.h"

namespace stipple::potree2 {

// hierarchy.bin: 22 bytes a node, little-endian, packed: type u8, child mask u8 (bit i: child x<<2|y<<1|z = i exists),
// points u32, byte offset u64, byte size u64. A piece lists its nodes breadth first. For a proxy, offset and size are
// those of the piece, in hierarchy.bin, that starts with this very node; otherwise of the points, in octree.bin.
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
enum class Encoding { uncompressed, brotli };

struct AttributeRange {
  std::vector<double> min;  // a value a component, as stored times scale plus offset
  std::vector<double> max;
  std::vector<std::uint64_t> histogram;  // of attributes of one byte: 256 counts; else empty
};

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
  std::vector<AttributeRange> ranges;  // of "position", then of each of schema
};

// metadata.json. parse throws Error naming `path`, the key and what is expected there.
Metadata parse_metadata(const std::string& text, const std::string& path);
std::string write_metadata(const Metadata& metadata);

// One record. `at` points to kRecordBytes bytes.
Record read_record(const std::byte* at);
void write_record(const Record& record, std::byte* at);

}  // namespace stipple::potree2
