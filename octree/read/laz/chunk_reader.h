// Points of single chunks as columns: what files, and the nodes of trees that keep theirs as LAZ chunks, have in
// common.
#pragma once

#include <memory>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/read/laz/point_decoder.h"

namespace stipple::laz {

// For one thread. Keeps the memory of its models from chunk to chunk.
class ChunkReader {
 public:
  // `fields` are those of the header that are wanted. `file` has to live longer.
  ChunkReader(const InputFile& file, const Format& format, std::vector<las::Field> fields);

  // Begins a chunk that lies within the file. Throws Error when it cannot be one.
  void begin(const Chunk& chunk);
  // Replaces the positions of `batch` by the next `count` of the chunk, no more in all than it has, and its columns by
  // those of `fields`. Throws Error naming chunk, point and byte when the data break off or contradict themselves.
  void read(std::size_t count, PointBatch& batch);
  // Behind the last point of a chunk: the byte of the file where it ended. See check_end().
  std::uint64_t end() { return decoder_->end(); }
  // Behind the last point of a chunk. Throws Error when it did not end where the chunk does.
  void check_end();

 private:
  const InputFile& file_;
  std::size_t record_length_;
  std::vector<las::Field> fields_;
  std::unique_ptr<PointDecoder> decoder_;
  Chunk chunk_;
  Buffer<std::byte> records_;
};

}  // namespace stipple::laz
