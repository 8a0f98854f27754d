// Points of single chunks as columns: what files, and the nodes of trees that keep theirs as LAZ chunks, have in
// common.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/read/laz/point_decoder.h"

namespace stipple::laz {

// Whether so many points may be made room for before they are decoded. Nothing that was measured comes near the limit:
// points take two to five bytes commonly, and some thousandth of one when all are alike.
bool is_plausible(std::uint64_t points, std::uint64_t bytes);

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
  // As read() of both: `other` was made for the same file, format and fields, and has another chunk. Faster, see
  // PointDecoder::decode_both().
  void read_both(std::size_t count, PointBatch& batch, ChunkReader& other, std::size_t other_count,
                 PointBatch& other_batch);
  // All points of a chunk, up to check_end(). A chunk that states more points than is plausible for its size is decoded
  // once before room is made for them.
  void read_chunk(const Chunk& chunk, PointBatch& batch);
  // Behind the last point of a chunk: the byte of the file where it ended. See check_end().
  std::uint64_t end() { return decoder_->end(); }
  // Behind the last point of a chunk. Throws Error when it did not end where the chunk does.
  void check_end();

 private:
  void decode_through();
  void make_room(std::size_t count, PointBatch& batch) const;
  std::span<std::byte> block_records(std::size_t first, std::size_t count);
  // The records of the block that begins with point `first` of the batch.
  void take_block(std::span<const std::byte> records, std::size_t first, PointBatch& batch) const;

  const InputFile& file_;
  std::size_t record_length_;
  std::vector<las::Field> fields_;
  std::unique_ptr<PointDecoder> decoder_;
  Chunk chunk_;
  Buffer<std::byte> records_;
};

}  // namespace stipple::laz
