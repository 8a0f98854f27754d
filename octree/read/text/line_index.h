// Where the lines of a text file are that hold points.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "octree/core/buffer.h"
#include "octree/read/input_file.h"

namespace stipple {

// A line of the file that is a row.
struct TextRow {
  std::string_view text;   // without the line end
  std::uint64_t line = 0;  // in the file, counted from 1
};

// What ends lines in the first 64 KiB of a file: '\n', or '\r' where there is no other.
char newline_of(const InputFile& file);

// Divides the text into chunks that can be read one by one, by several threads at once.
class LineIndex {
 public:
  using IsRow = bool (*)(std::string_view line);

  struct Start {
    std::uint64_t byte = 0;  // where the first line begins
    std::uint64_t line = 1;  // its number
    char newline = '\n';     // '\r' in files from before 2001
  };

  // Goes through the text once, on all cores. `is_row` says which lines are rows. Throws Error, naming the byte, for a
  // line of more than 16 MiB. `file` must outlive the index.
  LineIndex(const InputFile& file, const Start& start, IsRow is_row);

  std::uint64_t rows() const { return chunks_.back().first_row; }
  std::uint64_t lines() const { return chunks_.back().first_line - start_.line; }
  const Start& start() const { return start_; }
  // Whether the last line ends as lines do; a file without any does.
  bool ends_with_newline() const { return ends_with_newline_; }

  std::size_t chunks() const { return chunks_.size() - 1; }
  // Of the first row that begins in the chunk.
  std::uint64_t first_row(std::size_t chunk) const { return chunks_[chunk].first_row; }
  std::size_t rows_of(std::size_t chunk) const {
    return static_cast<std::size_t>(chunks_[chunk + 1].first_row - chunks_[chunk].first_row);
  }

  // Calls use(TextRow) for the rows [first, first + count), which must be there. Throws Error when the file is not the
  // one that was indexed any more. `scratch` is memory to reuse from call to call.
  template <class Use>
  void for_each_row(std::uint64_t first, std::uint64_t count, Buffer<std::byte>& scratch, const Use& use) const;

 private:
  struct Chunk {
    std::uint64_t first_row = 0;
    std::uint64_t first_line = 0;
  };

  // The lines that begin in a chunk, whole.
  std::string_view lines_of(std::size_t chunk, Buffer<std::byte>& scratch) const;
  Chunk count(std::string_view lines) const;  // how many of each
  std::size_t chunk_of(std::uint64_t row) const;
  [[noreturn]] void throw_changed() const;

  // The line at the begin of `text`, which loses it.
  std::string_view next_line(std::string_view& text) const {
    const std::size_t end = text.find(start_.newline);
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (!line.empty() && line.back() == '\r') line.remove_suffix(1);
    return line;
  }

  const InputFile& file_;
  Start start_;
  IsRow is_row_;
  std::vector<Chunk> chunks_;  // and one more with the totals
  bool ends_with_newline_ = true;
};

template <class Use>
void LineIndex::for_each_row(std::uint64_t first, std::uint64_t count, Buffer<std::byte>& scratch,
                             const Use& use) const {
  if (count == 0) return;
  for (std::size_t chunk = chunk_of(first); count > 0; ++chunk) {
    if (chunk >= chunks()) throw_changed();
    std::uint64_t row = chunks_[chunk].first_row;
    std::uint64_t line = chunks_[chunk].first_line;
    std::string_view text = lines_of(chunk, scratch);
    for (; count > 0 && !text.empty(); ++line) {
      const std::string_view content = next_line(text);
      if (!is_row_(content)) continue;
      if (row++ < first) continue;
      use(TextRow{content, line});
      ++first;
      --count;
    }
    if (count > 0 && row != chunks_[chunk + 1].first_row) throw_changed();
  }
}

}  // namespace stipple
