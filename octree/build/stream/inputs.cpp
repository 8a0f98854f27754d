#include "octree/build/stream/inputs.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <limits>
#include <numeric>
#include <system_error>

#include "octree/build/stream/row_writer.h"
#include "octree/core/error.h"

namespace stipple {
namespace {

double file_bytes(const std::string& path) {
  std::error_code none;
  const std::uintmax_t bytes = std::filesystem::file_size(path, none);
  return none ? 0.0 : static_cast<double>(bytes);  // generated scenes are no file
}

std::int32_t to_int32(double value) {
  constexpr double kLow = std::numeric_limits<std::int32_t>::min();
  constexpr double kHigh = std::numeric_limits<std::int32_t>::max();
  return static_cast<std::int32_t>(std::clamp(std::round(value), kLow, kHigh));
}

// What the header promises, on the source's grid; empty when it promises nothing or nonsense.
GridBox stated_box(const SourceInfo& info) {
  GridBox box;
  if (info.stated_bounds.empty()) return box;
  const glm::dvec3 low = info.grid.grid_from_world(info.stated_bounds.min);
  const glm::dvec3 high = info.grid.grid_from_world(info.stated_bounds.max);
  for (int axis = 0; axis < 3; ++axis)
    if (!std::isfinite(low[axis]) || !std::isfinite(high[axis]) || low[axis] > high[axis]) return box;
  box.extend({to_int32(low.x), to_int32(low.y), to_int32(low.z)});
  box.extend({to_int32(high.x), to_int32(high.y), to_int32(high.z)});
  return box;
}

// What one thread learns while reading one source.
struct Seen {
  GridBox box;
  double rounding = 0.0;
  std::uint64_t points = 0;
};

struct PositionWorkspace {
  Seen seen;
  Buffer<glm::ivec3> moved;
};

std::span<const glm::ivec3> moved_positions(const GridTransform& transform, const Buffer<glm::ivec3>& positions,
                                            PositionWorkspace& workspace) {
  if (transform.identity()) return positions;
  workspace.moved.resize(positions.size());
  for (std::size_t i = 0; i < positions.size(); ++i) {
    workspace.moved[i] = transform(positions[i]);
    workspace.seen.rounding = std::max(workspace.seen.rounding, transform.rounding(positions[i]));
  }
  return workspace.moved;
}

void check_count(const SourceInfo& info, std::uint64_t points) {
  if (points != info.point_count)
    throw Error(
        fmt::format("{}: {} points were read, and {} were expected. The file changed or is damaged; copy or "
                    "download it again.",
                    info.path, points, info.point_count));
}

GridBox transformed(const GridTransform& transform, const GridBox& box) {
  GridBox result;
  if (box.empty()) return result;
  result.extend(transform(box.min));
  result.extend(transform(box.max));
  return result;
}

}  // namespace

Inputs::Inputs(std::span<const std::unique_ptr<PointSource>> sources, BuildMonitor& monitor)
    : monitor_(monitor), schema_(merged_schema(sources)), record_bytes_(stipple::record_bytes(schema_)) {
  for (const auto& source : sources) {
    const SourceInfo& info = source->info();
    const double points = static_cast<double>(std::max<std::uint64_t>(info.point_count, 1));
    Source& added = sources_.emplace_back(Source{source.get(), {}, stated_box(info), file_bytes(info.path) / points});
    for (const Attribute& attribute : info.schema) added.attributes.push_back(*find_attribute(schema_, attribute.name));
    point_count_ += info.point_count;
  }
  monitor_.set_points(point_count_);
  choose_grid();
}

void Inputs::choose_grid() {
  std::vector<GriddedBox> boxes;
  for (const Source& source : sources_) boxes.push_back({source.points->info().grid, source.box});
  grid_ = common_grid(boxes);
  bounds_ = {};
  for (const GriddedBox& source : boxes) bounds_.extend(transformed({source.grid, grid_}, source.box));
}

// Many small files are read at once, a large one by all threads.
void Inputs::for_each_source(const std::function<void(std::size_t)>& read) const {
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, sources_.size(), [&](std::size_t) {
    const std::size_t source = next.fetch_add(1);
    // A thread that waits for one file must not begin another: each takes memory
    tbb::this_task_arena::isolate([&] { read(source); });
  });
}

bool Inputs::read_positions(const PositionConsumer& consume) {
  std::vector<Seen> seen(sources_.size());
  for_each_source([&](std::size_t s) {
    const PointSource& source = *sources_[s].points;
    const GridTransform transform(source.info().grid, grid_);
    tbb::enumerable_thread_specific<PositionWorkspace> workspaces;
    source.read({}, [&](const PointBatch& batch) {
      PositionWorkspace& workspace = workspaces.local();
      for (const glm::ivec3& p : batch.positions) workspace.seen.box.extend(p);
      workspace.seen.points += batch.positions.size();
      consume(moved_positions(transform, batch.positions, workspace));
      monitor_.add_points(BuildPhase::counting, batch.positions.size());
      monitor_.add_read(sources_[s].bytes_of(batch));
    });
    for (const PositionWorkspace& workspace : workspaces) {
      seen[s].box.extend(workspace.seen.box);
      seen[s].points += workspace.seen.points;
      seen[s].rounding = std::max(seen[s].rounding, workspace.seen.rounding);
    }
    check_count(source.info(), seen[s].points);
  });
  const Grid old_grid = grid_;
  const GridBox old_bounds = bounds_;
  largest_rounding_ = 0.0;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    sources_[s].box = seen[s].box;
    largest_rounding_ = std::max(largest_rounding_, seen[s].rounding);
  }
  choose_grid();
  return grid_.offset == old_grid.offset && grid_.scale == old_grid.scale && bounds_ == old_bounds;
}

void Inputs::read_records(AttributeStats& stats, const RecordConsumer& consume) {
  tbb::enumerable_thread_specific<AttributeStats> parts([&] { return AttributeStats(schema_); });
  for_each_source([&](std::size_t s) {
    const SourceInfo& info = sources_[s].points->info();
    const RowWriter writer(info.schema, sources_[s].attributes, schema_, {info.grid, grid_});
    std::vector<std::size_t> all(info.schema.size());
    std::iota(all.begin(), all.end(), std::size_t{0});
    tbb::enumerable_thread_specific<Buffer<std::byte>> buffers;
    std::atomic<std::uint64_t> points{0};
    sources_[s].points->read(all, [&](const PointBatch& batch) {
      Buffer<std::byte>& records = buffers.local();
      writer.write(batch, records, parts.local());
      for (const glm::ivec3& p : batch.positions)
        if (!sources_[s].box.contains(p))
          throw Error(
              fmt::format("{}: the file changed while it was read. Build again when it is complete.", info.path));
      points += batch.positions.size();
      consume(records);
      monitor_.add_read(sources_[s].bytes_of(batch));
    });
    check_count(info, points);
  });
  for (const AttributeStats& part : parts) stats.add(part);
}

AttributeRange Inputs::position_range() const {
  const WorldBox box = bounds_.empty() ? WorldBox{glm::dvec3(0.0), glm::dvec3(0.0)} : world_box(grid_, bounds_);
  return {{box.min.x, box.min.y, box.min.z}, {box.max.x, box.max.y, box.max.z}, {}};
}

void read_until_right(const std::function<bool()>& read) {
  for (int attempt = 0; attempt < 3; ++attempt)
    if (read()) return;
  throw Error(
      "the positions differ each time they are read: a file is being written. Build again when it is complete.");
}

Error changed_while_read() {
  return Error("a file changed while it was read. Build again when all are complete.");
}

}  // namespace stipple
