#include "octree/read/las/las_source.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <utility>
#include <vector>

#include "octree/core/error.h"
#include "octree/read/las/las_decode.h"

namespace stipple {
namespace {

constexpr std::size_t kMaxBatchPoints = 65'536;
// Long records make smaller batches, so that memory stays bounded.
constexpr std::size_t kMaxBatchBytes = std::size_t{4} << 20;

// What one thread reuses from batch to batch.
struct Workspace {
  Buffer<std::byte> records;
  PointBatch batch;
};

// Points [first, first + count) of `file` into `workspace.batch`.
void decode_batch(const InputFile& file, const las::Header& header, std::span<const las::Field> fields,
                  std::uint64_t first, std::size_t count, Workspace& workspace) {
  // Read rather than mapped: page faults cost more than the copy does, and a file that shrinks meanwhile is an error
  // instead of a SIGBUS.
  workspace.records.resize(count * header.record_length);
  file.read_at(header.points_begin + first * header.record_length, workspace.records);

  PointBatch& batch = workspace.batch;
  batch.first = first;
  batch.positions.resize(count);
  las::decode_positions(workspace.records, header.record_length, batch.positions);
  for (std::size_t c = 0; c < fields.size(); ++c) {
    batch.columns[c].resize(count);
    las::decode_field(fields[c], workspace.records, header.record_length, batch.columns[c].bytes);
  }
}

}  // namespace

LasSource::LasSource(const std::string& path)
    : file_(path),
      header_(las::parse_header(file_.map().bytes(), path)),
      info_(las::source_info(header_, path, "LAS")) {
  if (header_.compressed)
    throw file_error(
        path, las::kPointFormat,
        fmt::format("the points are LAZ-compressed (point format {} with bit 7 set), and uncompressed ones "
                    "were expected.",
                    header_.point_format));
}

void LasSource::read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const {
  std::vector<las::Field> fields;
  std::vector<Column> empty_columns;
  for (const std::size_t index : attributes) {
    fields.push_back(header_.fields.at(index));
    empty_columns.push_back({fields.back().attribute, {}});
  }
  tbb::enumerable_thread_specific<Workspace> workspaces([&] { return Workspace{{}, {0, {}, empty_columns}}; });

  const std::uint64_t batch_points =
      std::clamp<std::uint64_t>(kMaxBatchBytes / header_.record_length, 1, kMaxBatchPoints);
  const std::uint64_t batches = (header_.point_count + batch_points - 1) / batch_points;
  // Tasks split the work from its ends; a shared counter makes the disk see it from front to back.
  std::atomic<std::uint64_t> next{0};
  tbb::parallel_for(std::uint64_t{0}, batches, [&](std::uint64_t) {
    const std::uint64_t first = next.fetch_add(1) * batch_points;
    const std::uint64_t count = std::min(batch_points, header_.point_count - first);
    Workspace& workspace = workspaces.local();
    decode_batch(file_, header_, fields, first, static_cast<std::size_t>(count), workspace);
    // A consumer that waits for tasks of its own must not be handed another batch in the workspace it still reads.
    tbb::this_task_arena::isolate([&] { consume(workspace.batch); });
  });
}

}  // namespace stipple
