// Decodes the points of one chunk after the other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>

#include "octree/core/error.h"
#include "octree/read/las/las_format.h"
#include "octree/read/laz/chunk_input.h"
#include "octree/read/laz/laz_format.h"

namespace stipple::laz {

class PointDecoder {
 public:
  virtual ~PointDecoder() = default;
  PointDecoder() = default;
  PointDecoder(const PointDecoder&) = delete;
  PointDecoder& operator=(const PointDecoder&) = delete;

  // Begins a chunk that lies within the file and has at least one point.
  virtual void begin(const Chunk& chunk) = 0;
  // Fills `records` with the next points of the chunk, records of the format's record_length. No more in all than the
  // chunk has. Throws Error naming chunk, point and byte when the data break off or are what no encoder writes.
  virtual void decode(std::span<std::byte> records) = 0;
  // As decode() of both: `other` was made for the same file, format and fields, and has another chunk. Streams depend
  // on themselves alone, so that a processor that works on two at once waits less.
  virtual void decode_both(std::span<std::byte> records, PointDecoder& other, std::span<std::byte> other_records) = 0;
  // To be called behind the last point. Returns the byte of the file at which the chunk ended, which is known only then
  // when there is no table of chunks.
  virtual std::uint64_t end() = 0;
};

// What is wanted of the points. Fields that are not asked for may hold anything.
//
// `file` has to live longer. Memory: some 100 KiB to 3 MiB of models, and the chunk: a window of it, or of layered
// chunks the layers that `fields` need.
std::unique_ptr<PointDecoder> make_point_decoder(const InputFile& file, const Format& format,
                                                 std::span<const las::Field> fields);

// "PATH: at byte OFFSET: chunk INDEX, of N points, ... WHAT"
Error chunk_error(const std::string& path, std::uint64_t offset, const Chunk& chunk, std::string_view what);

}  // namespace stipple::laz
