#include "octree/read/laz/chunk_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "octree/core/error.h"
#include "octree/read/laz/integer_decoder.h"

namespace stipple::laz {
namespace {

constexpr std::uint64_t kPointerBytes = 8;                    // i64 before the first chunk: where the table is
constexpr std::uint64_t kTableHeaderBytes = 8;                // u32 version, 0; u32 number of chunks
constexpr std::uint64_t kPointerAtEnd = 0xFFFFFFFFFFFFFFFFu;  // the writer could not go back: see the last 8 bytes
constexpr std::size_t kPadding = 64;

// What makes a table unusable: said as a warning or an error.
struct Defect {
  std::uint64_t offset;
  std::string what;
};

class TableReader {
 public:
  TableReader(const InputFile& file, const las::Header& header, const Format& format)
      : file_(file), header_(header), format_(format), begin_(header.points_begin + kPointerBytes) {}

  // The chunks, or why there are none to be known.
  std::optional<Defect> read(ChunkTable& table) {
    const std::uint64_t place = find();
    if (place == header_.points_begin || place == 0)
      return Defect{header_.points_begin, "the writer was interrupted before it wrote the table of chunks"};
    if (place < begin_ || place > file_.size() || file_.size() - place < kTableHeaderBytes)
      return Defect{header_.points_begin,
                    fmt::format("the table of chunks is said to stand at byte {}, between byte {} and the end of the "
                                "file at byte {} was expected",
                                place, begin_, file_.size())};
    table.end = place;
    return read_at(place, table);
  }

 private:
  template <class T>
  T number_at(std::uint64_t offset) const {
    T value;
    file_.read_at(offset, std::as_writable_bytes(std::span(&value, 1)));
    return value;
  }

  std::uint64_t find() const {
    const auto place = number_at<std::uint64_t>(header_.points_begin);
    return place == kPointerAtEnd ? number_at<std::uint64_t>(file_.size() - kPointerBytes) : place;
  }

  std::optional<Defect> read_at(std::uint64_t place, ChunkTable& table) {
    const auto version = number_at<std::uint32_t>(place);
    const auto count = number_at<std::uint32_t>(place + 4);
    if (version != 0) return Defect{place, fmt::format("the table of chunks has version {}, and 0 is read", version)};
    // A chunk holds its first point as it is
    const std::uint64_t most = (place - begin_) / format_.record_length;
    if (count > most)
      return Defect{place + 4, fmt::format("{} chunks are stated, and there is room for {}", count, most)};
    return decode(place + kTableHeaderBytes, count, table);
  }

  // Numbers of points, where they vary, and of bytes, each predicted from the one before.
  std::optional<Defect> decode(std::uint64_t offset, std::uint32_t count, ChunkTable& table) {
    // No number takes more than eight bytes
    Buffer<std::byte> bytes(std::min<std::uint64_t>(file_.size() - offset, 16 + std::uint64_t{count} * 16));
    const std::size_t size = bytes.size();
    file_.read_at(offset, bytes);
    bytes.resize(size + kPadding, std::byte{0});
    ArithmeticDecoder decoder;
    decoder.start(bytes.data());
    const auto numbers = std::make_unique<IntegerDecoder<32, 2>>();
    numbers->init();
    std::uint64_t at = begin_;
    std::uint64_t points = 0;
    std::uint32_t chunk_points = 0;
    std::uint32_t chunk_bytes = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      if (format_.chunk_size == kVariableChunks)
        chunk_points = next(*numbers, decoder, chunk_points, 0);
      else
        chunk_points =
            static_cast<std::uint32_t>(std::min<std::uint64_t>(format_.chunk_size, header_.point_count - points));
      chunk_bytes = next(*numbers, decoder, chunk_bytes, 1);
      const bool cut_off = decoder.at > bytes.data() + size;
      if (cut_off || decoder.broken != 0 || chunk_bytes == 0 || chunk_bytes > table.end - at)
        return Defect{cut_off ? file_.size() : offset,
                      fmt::format("the table of chunks is damaged: chunk {} at byte {} has {} bytes, and the chunks "
                                  "end at byte {}",
                                  i, at, chunk_bytes, table.end)};
      if (chunk_points > 0) table.chunks.push_back({at, chunk_bytes, points, chunk_points, i});
      at += chunk_bytes;
      points += chunk_points;
    }
    if (points == header_.point_count) return std::nullopt;
    return Defect{offset, fmt::format("the chunks of the table hold {} points, and the header states {}", points,
                                      header_.point_count)};
  }

  static std::uint32_t next(IntegerDecoder<32, 2>& numbers, ArithmeticDecoder& decoder, std::uint32_t last,
                            unsigned context) {
    return static_cast<std::uint32_t>(numbers.decode(decoder, static_cast<std::int32_t>(last), context));
  }

  const InputFile& file_;
  const las::Header& header_;
  const Format& format_;
  std::uint64_t begin_;
};

// Where the chunks end at the latest, as far as the header knows.
std::uint64_t latest_end(const InputFile& file, const las::Header& header) {
  std::uint64_t end = file.size();
  for (const las::Record& record : header.records)
    if (record.begin > header.points_begin) end = std::min(end, record.begin - las::kEvlrHeaderSize);
  return end;
}

}  // namespace

ChunkTable read_chunk_table(const InputFile& file, const las::Header& header, const Format& format,
                            std::vector<std::string>& warnings) {
  ChunkTable table;
  table.end = latest_end(file, header);
  if (header.point_count == 0) return table;
  const std::uint64_t before = format.compressor == Compressor::pointwise ? 0 : kPointerBytes;
  table.begin = header.points_begin + before;
  if (table.end < table.begin || table.end - table.begin < format.record_length)
    throw file_error(file.path(), table.end,
                     fmt::format("the file, or what may hold points of it, ends here, and {} points were expected from "
                                 "byte {} on. It was cut off; copy or download it again.",
                                 header.point_count, header.points_begin));
  if (format.compressor == Compressor::pointwise) {
    table.chunks.push_back({table.begin, table.end - table.begin, 0, header.point_count, 0});
    return table;
  }
  const auto defect = TableReader(file, header, format).read(table);
  if (!defect) return table;
  if (format.chunk_size == kVariableChunks)
    throw file_error(file.path(), defect->offset,
                     fmt::format("{}. Without it, chunks of variable size cannot be found. The file is damaged or was "
                                 "cut off; copy or download it again.",
                                 defect->what));
  table.chunks.clear();
  table.end = latest_end(file, header);
  warnings.push_back(fmt::format("At byte {}: {}; the points are read from front to back, on one core.", defect->offset,
                                 defect->what));
  return table;
}

}  // namespace stipple::laz
