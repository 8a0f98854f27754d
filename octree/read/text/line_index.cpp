#include "octree/read/text/line_index.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <string>

#include "octree/core/error.h"

namespace stipple {
namespace {

constexpr std::uint64_t kChunkBytes = std::uint64_t{512} << 10;
constexpr std::uint64_t kLongestLine = std::uint64_t{16} << 20;
constexpr std::uint64_t kTailBytes = 4096;  // read at a time to find the end of the last line

}  // namespace

char newline_of(const InputFile& file) {
  constexpr std::uint64_t kLooked = std::uint64_t{64} << 10;
  std::string start(static_cast<std::size_t>(std::min(file.size(), kLooked)), '\0');
  file.read_at(0, std::as_writable_bytes(std::span(start)));
  const bool old = start.find('\n') == std::string::npos && start.find('\r') != std::string::npos;
  return old ? '\r' : '\n';
}

LineIndex::LineIndex(const InputFile& file, const Start& start, IsRow is_row)
    : file_(file), start_(start), is_row_(is_row) {
  const std::uint64_t bytes = file.size() - std::min(file.size(), start.byte);
  const auto chunks = static_cast<std::size_t>((bytes + kChunkBytes - 1) / kChunkBytes);
  std::vector<Chunk> counts(chunks);
  tbb::enumerable_thread_specific<Buffer<std::byte>> scratch;
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t) {
    const std::size_t chunk = next.fetch_add(1);
    counts[chunk] = count(lines_of(chunk, scratch.local()));
  });
  chunks_.push_back({0, start.line});
  for (const Chunk& chunk : counts)
    chunks_.push_back({chunks_.back().first_row + chunk.first_row, chunks_.back().first_line + chunk.first_line});
  if (bytes > 0) {
    std::byte last{};
    file.read_at(file.size() - 1, {&last, 1});
    ends_with_newline_ = static_cast<char>(last) == start.newline;
  }
}

std::string_view LineIndex::lines_of(std::size_t chunk, Buffer<std::byte>& scratch) const {
  const std::uint64_t begin = start_.byte + chunk * kChunkBytes;
  const std::uint64_t end = std::min(begin + kChunkBytes, file_.size());
  // With the byte before, which ends a line or belongs to one of the chunk before
  const std::uint64_t from = chunk == 0 ? begin : begin - 1;
  scratch.resize(static_cast<std::size_t>(end - from));
  file_.read_at(from, scratch);
  const auto text = [&] { return std::string_view(reinterpret_cast<const char*>(scratch.data()), scratch.size()); };
  std::size_t first = 0;
  if (chunk > 0) {
    first = text().find(start_.newline);
    if (first == std::string_view::npos || ++first == scratch.size()) return {};
  }
  // The last line reaches into the next chunk
  while (text().back() != start_.newline && from + scratch.size() < file_.size()) {
    const std::size_t old = scratch.size();
    if (old > kChunkBytes + kLongestLine)
      throw file_error(file_.path(), end,
                       fmt::format("a line of more than {} bytes was found, and lines of numbers were expected. Check "
                                   "that the file is what its begin says.",
                                   kLongestLine));
    // More at a time the longer it gets, so that it is not gone through again and again
    const std::uint64_t most = std::min(kChunkBytes + kLongestLine + 1, file_.size() - from) - old;
    const std::uint64_t more = std::clamp<std::uint64_t>(old - kChunkBytes / 2, std::min(kTailBytes, most), most);
    scratch.resize(old + static_cast<std::size_t>(more));
    file_.read_at(from + old, std::span(scratch).subspan(old));
    if (const std::size_t newline = text().find(start_.newline, old); newline != std::string_view::npos)
      scratch.resize(newline + 1);
  }
  return text().substr(first);
}

LineIndex::Chunk LineIndex::count(std::string_view lines) const {
  Chunk counted;
  for (; !lines.empty(); ++counted.first_line) counted.first_row += is_row_(next_line(lines));
  return counted;
}

std::size_t LineIndex::chunk_of(std::uint64_t row) const {
  const auto after = std::ranges::upper_bound(chunks_, row, {}, &Chunk::first_row);
  return static_cast<std::size_t>(after - chunks_.begin()) - 1;
}

void LineIndex::throw_changed() const {
  throw Error(fmt::format("{}: the file changed while it was read. Open it again when it is complete.", file_.path()));
}

}  // namespace stipple
