// Where the chunks of a LAZ file are.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "octree/read/laz/chunk_input.h"
#include "octree/read/laz/laz_format.h"

namespace stipple::laz {

struct ChunkTable {
  // In the order of their points. Empty when the file has no points, or no table.
  std::vector<Chunk> chunks;
  // Byte of the first chunk, and the first byte that belongs to none.
  std::uint64_t begin = 0;
  std::uint64_t end = 0;
};

// Chunks of the table lie within the file one behind the other, and have header.point_count points in all. A file that
// is not chunked is one chunk. Where the table of chunks of a fixed size is missing or damaged, which happens when a
// writer was interrupted, a sentence is appended to `warnings`: the place of a chunk then is known only when that
// before it is decoded.
//
// Throws Error naming the byte when chunks of variable size have no table, when the table contradicts the header, and
// when the file is too short for its first chunk.
ChunkTable read_chunk_table(const InputFile& file, const las::Header& header, const Format& format,
                            std::vector<std::string>& warnings);

}  // namespace stipple::laz
