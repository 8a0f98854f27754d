// The bytes of one chunk, a window at a time.
#pragma once

#include <cstddef>
#include <cstdint>

#include "octree/core/buffer.h"
#include "octree/read/input_file.h"

namespace stipple::laz {

// Points of a file that are decoded without those before them.
struct Chunk {
  std::uint64_t begin = 0;  // byte of the file
  std::uint64_t bytes = 0;
  std::uint64_t first = 0;  // point of the source
  std::uint64_t points = 0;
  std::uint64_t index = 0;  // among the chunks of the file, for messages
};

// Reads a chunk from front to back. Memory: one window, whatever the size of the chunk. kPadding zeros stand behind its
// last byte, so that whoever reads a little too far can be told afterwards.
class ChunkInput {
 public:
  // `longest`: bytes that may be read beyond a place that is not beyond limit().
  ChunkInput(const InputFile& file, std::size_t longest) : file_(&file), longest_(longest) {}

  // Begins with the first byte of `chunk`, which lies within the file.
  void begin(const Chunk& chunk);

  const std::byte* data() const { return window_.data(); }
  // Places up to here may be read from, `longest` bytes on; the end of the chunk when all of it is in the window.
  const std::byte* limit() const { return window_.data() + limit_; }
  bool at_end() const { return unread_ == 0; }
  // Moves the window so that it begins with `place`; returns where that now is. Does nothing at the end.
  const std::byte* advance(const std::byte* place);

  // The byte of the file that stands at `place`.
  std::uint64_t file_offset(const std::byte* place) const {
    return window_begin_ + static_cast<std::uint64_t>(place - window_.data());
  }

 private:
  void fill(std::size_t kept);

  const InputFile* file_;
  std::size_t longest_;
  Buffer<std::byte> window_;
  std::uint64_t window_begin_ = 0;  // byte of the file
  std::uint64_t unread_ = 0;        // bytes of the chunk behind the window
  std::size_t limit_ = 0;
};

}  // namespace stipple::laz
