#include "octree/read/laz/laz_source.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <array>
#include <atomic>

#include "octree/core/error.h"
#include "octree/read/laz/chunk_reader.h"

namespace stipple {
namespace {

constexpr std::uint64_t kMaxBatchPoints = 65'536;

// Chunks are decoded two at a time when there are more than these for every thread.
constexpr std::size_t kChunksForPairs = 4;

// What one thread reuses from chunk to chunk.
struct Workspace {
  laz::ChunkReader reader;
  PointBatch batch;
  const laz::Chunk* chunk = nullptr;
  std::uint64_t done = 0;  // points of the chunk

  void begin(const laz::Chunk& begun) {
    chunk = &begun;
    done = 0;
    reader.begin(begun);
  }
  // Points of the next batch.
  std::size_t next() const { return static_cast<std::size_t>(std::min(kMaxBatchPoints, chunk->points - done)); }
  void deliver(const BatchConsumer& consume) {
    batch.first = chunk->first + done;
    done += batch.positions.size();
    // A consumer that waits for tasks of its own must not be handed another batch in the workspace it still reads.
    if (!batch.positions.empty()) tbb::this_task_arena::isolate([&] { consume(batch); });
  }
};

// All points of a chunk.
void deliver(const laz::Chunk& chunk, Workspace& workspace, const BatchConsumer& consume) {
  workspace.begin(chunk);
  while (workspace.next() > 0) {
    workspace.reader.read(workspace.next(), workspace.batch);
    workspace.deliver(consume);
  }
}

// All points of two chunks.
void deliver(std::span<const laz::Chunk, 2> chunks, std::array<Workspace, 2>& pair, const BatchConsumer& consume) {
  for (std::size_t i = 0; i < 2; ++i) pair[i].begin(chunks[i]);
  while (pair[0].next() + pair[1].next() > 0) {
    pair[0].reader.read_both(pair[0].next(), pair[0].batch, pair[1].reader, pair[1].next(), pair[1].batch);
    for (Workspace& workspace : pair) workspace.deliver(consume);
  }
}

las::Header load_header(const InputFile& file) {
  las::Header header = las::parse_header(file.map().bytes(), file.path());
  if (!header.compressed)
    throw file_error(file.path(), las::kPointFormat, "the points are not compressed; this is LAS and no LAZ file.");
  return header;
}

std::string describe(const laz::Format& format, const las::Header& header) {
  const std::string chunks = format.compressor == laz::Compressor::pointwise ? "not chunked"
                             : format.chunk_size == laz::kVariableChunks
                                 ? "chunks of variable size"
                                 : fmt::format("chunks of {} points", format.chunk_size);
  return fmt::format("point format {}, {} bytes a point unpacked, {}, items of version {}", header.point_format,
                     header.record_length, chunks, format.version);
}

}  // namespace

LazSource::LazSource(const std::string& path)
    : file_(path),
      header_(load_header(file_)),
      format_(laz::read_format(file_.map().bytes(), header_, path)),
      info_(las::source_info(header_, path, "LAZ")),
      table_(laz::read_chunk_table(file_, header_, format_, info_.warnings)) {
  info_.encoding = describe(format_, header_);
  if (!laz::is_plausible(header_.point_count, file_.size())) read({}, [](const PointBatch&) {});
}

void LazSource::read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const {
  std::vector<las::Field> fields;
  for (const std::size_t index : attributes) fields.push_back(header_.fields.at(index));
  if (header_.point_count == 0) return;
  if (table_.chunks.empty())
    read_without_table(fields, consume);
  else
    read_chunks(fields, consume);
}

void LazSource::read_chunks(const std::vector<las::Field>& fields, const BatchConsumer& consume) const {
  const auto make = [&] { return Workspace{laz::ChunkReader(file_, format_, fields), {}}; };
  tbb::enumerable_thread_specific<std::array<Workspace, 2>> workspaces([&] {
    return std::array<Workspace, 2>{make(), make()};
  });
  const std::span<const laz::Chunk> chunks = table_.chunks;
  const auto threads = static_cast<std::size_t>(tbb::this_task_arena::max_concurrency());
  const bool in_pairs = format_.compressor == laz::Compressor::chunked && chunks.size() > kChunksForPairs * threads;
  const std::size_t step = in_pairs ? 2 : 1;
  // Tasks split the work from its ends; a shared counter makes the disk see it from front to back.
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, (chunks.size() + step - 1) / step, [&](std::size_t) {
    std::array<Workspace, 2>& pair = workspaces.local();
    const std::size_t first = next.fetch_add(step);
    const std::size_t count = std::min(step, chunks.size() - first);
    if (count == 2)
      deliver(chunks.subspan(first).first<2>(), pair, consume);
    else
      deliver(chunks[first], pair[0], consume);
    // Where a file that is not chunked ends, it does not say
    if (format_.compressor == laz::Compressor::pointwise) return;
    for (std::size_t i = 0; i < count; ++i) pair[i].reader.check_end();
  });
}

void LazSource::read_without_table(const std::vector<las::Field>& fields, const BatchConsumer& consume) const {
  Workspace workspace{laz::ChunkReader(file_, format_, fields), {}};
  laz::Chunk chunk{table_.begin, 0, 0, 0, 0};
  while (chunk.first < header_.point_count) {
    chunk.points = std::min<std::uint64_t>(format_.chunk_size, header_.point_count - chunk.first);
    chunk.bytes = table_.end - chunk.begin;
    deliver(chunk, workspace, consume);
    chunk.begin = workspace.reader.end();
    chunk.first += chunk.points;
    ++chunk.index;
  }
}

}  // namespace stipple
