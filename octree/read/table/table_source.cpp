#include "octree/read/table/table_source.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <limits>
#include <utility>

#include "octree/core/error.h"
#include "octree/read/table/block_positions.h"
#include "octree/read/table/position_scan.h"

namespace stipple {
namespace {

// Calls work(block) for all blocks, on all cores.
template <class Work>
void for_each_block(std::size_t blocks, const Work& work) {
  // Tasks split the work from its ends; a shared counter makes the disk see it from front to back.
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, blocks, [&](std::size_t) { work(next.fetch_add(1)); });
}

// The columns of some fields of one block.
class FieldColumns {
 public:
  FieldColumns(const PointTable& table, std::vector<std::size_t> fields) : table_(table), fields_(std::move(fields)) {
    std::ranges::sort(fields_);
    fields_.erase(std::unique(fields_.begin(), fields_.end()), fields_.end());
    for (const std::size_t f : fields_) {
      const TableField& field = table.fields()[f];
      columns_.push_back({{field.name, field.type, field.components, 1.0, 0.0}, {}});
    }
  }

  void decode(std::size_t block) {
    for (Column& column : columns_) column.resize(table_.rows(block));
    table_.decode(block, fields_, columns_, scratch_);
  }

  const Column& of(std::size_t field) const {
    return columns_[static_cast<std::size_t>(std::ranges::lower_bound(fields_, field) - fields_.begin())];
  }

 private:
  const PointTable& table_;
  std::vector<std::size_t> fields_;
  std::vector<Column> columns_;
  Buffer<std::byte> scratch_;
};

void load_positions(const TableMeaning& meaning, const FieldColumns& columns, std::size_t rows,
                    BlockPositions& positions) {
  std::array<const Column*, 3> of_axes{};
  for (std::size_t a = 0; a < 3; ++a)
    if (meaning.position[a]) of_axes[a] = &columns.of(*meaning.position[a]);
  positions.load(of_axes, rows);
}

// The fields that the positions and the attributes are made of.
std::vector<std::size_t> fields_of(const TableMeaning& meaning, std::span<const std::size_t> attributes) {
  std::vector<std::size_t> fields;
  for (const auto& field : meaning.position)
    if (field) fields.push_back(*field);
  for (const std::size_t index : attributes) {
    const Derivation& from = meaning.attributes.at(index);
    const std::size_t parts = from.kind == Derivation::Kind::color ? from.parts.size() : 1;
    for (std::size_t p = 0; p < parts; ++p) fields.push_back(from.parts[p].field);
  }
  return fields;
}

void derive(const Derivation& derivation, ColorDepth depth, const FieldColumns& columns, Column& out) {
  const Column& first = columns.of(derivation.parts[0].field);
  out.resize(first.points());
  switch (derivation.kind) {
    case Derivation::Kind::copy:
      std::ranges::copy(first.bytes, out.bytes.begin());
      break;
    case Derivation::Kind::color:
      for (int c = 0; c < 3; ++c) {
        const FieldPart& part = derivation.parts[static_cast<std::size_t>(c)];
        put_channel(columns.of(part.field), part.component, depth, c, out.as<std::uint16_t>());
      }
      break;
    case Derivation::Kind::packed_color:
      put_packed(first, out.as<std::uint16_t>());
      break;
    case Derivation::Kind::packed_alpha:
      put_packed_alpha(first, out.as<std::uint8_t>());
      break;
  }
}

// What the whole file tells about positions and colours.
struct Scan {
  std::array<AxisScan, 3> axes;
  double brightest = -std::numeric_limits<double>::infinity();  // only looked for where the type does not tell it
};

// The colour whose depth its type does not tell, if there is one; as index of the attribute.
std::vector<std::size_t> untold_colors(const TableMeaning& meaning, const std::vector<TableField>& fields) {
  for (std::size_t a = 0; a < meaning.attributes.size(); ++a) {
    const Derivation& from = meaning.attributes[a];
    if (from.kind == Derivation::Kind::color &&
        std::ranges::any_of(from.parts, [&](const FieldPart& p) { return !tells_depth(fields[p.field].type); }))
      return {a};
  }
  return {};
}

double brightest_of(const Derivation& derivation, const FieldColumns& columns) {
  double most = -std::numeric_limits<double>::infinity();
  for (const FieldPart& part : derivation.parts) {
    const Column& column = columns.of(part.field);
    for (std::size_t i = 0; i < column.points(); ++i) most = std::max(most, value_at(column, i, part.component));
  }
  return most;
}

std::string text_of(const glm::dvec3& v) {
  if (v.x == v.y && v.y == v.z) return fmt::format("{}", v.x);
  return fmt::format("{}, {} and {}", v.x, v.y, v.z);
}

WorldBox box_of(const std::array<AxisScan, 3>& axes) {
  WorldBox box;
  if (axes[0].empty()) return box;
  for (int a = 0; a < 3; ++a) {
    box.min[a] = axes[static_cast<std::size_t>(a)].range().min;
    box.max[a] = axes[static_cast<std::size_t>(a)].range().max;
  }
  return box;
}

}  // namespace

struct TableSource::Workspace {
  FieldColumns columns;
  BlockPositions positions;
  PointBatch batch;
};

TableSource::TableSource(std::unique_ptr<const PointTable> table, SourceInfo info)
    : table_(std::move(table)),
      meaning_(meaning_of(table_->fields(), info.path + ":")),
      info_(std::move(info)),
      blocks_(table_->blocks()) {
  for (const Derivation& from : meaning_.attributes) info_.schema.push_back(from.attribute);
  if (!meaning_.position[2]) info_.warnings.push_back("The points have no z; it is taken as 0.");
  scan();
}

void TableSource::scan() {
  const std::vector<TableField>& fields = table_->fields();
  const std::vector<std::size_t> colors = untold_colors(meaning_, fields);
  const bool single = fields[*meaning_.position[0]].type == ScalarType::f32;
  struct Thread {
    FieldColumns columns;
    BlockPositions positions;
    Scan scan;
  };
  tbb::enumerable_thread_specific<Thread> threads([&] {
    return Thread{FieldColumns(*table_, fields_of(meaning_, colors)), {}, {}};
  });
  for_each_block(blocks_.size(), [&](std::size_t block) {
    Thread& thread = threads.local();
    thread.columns.decode(block);
    load_positions(meaning_, thread.columns, table_->rows(block), thread.positions);
    blocks_[block].points = static_cast<std::uint32_t>(thread.positions.size());
    for (int a = 0; a < 3; ++a) {
      AxisScan axis;  // block by block, so that the result does not depend on threads
      axis.add(thread.positions.axis(a), single);
      thread.scan.axes[static_cast<std::size_t>(a)].merge(axis);
    }
    for (const std::size_t color : colors)
      thread.scan.brightest = std::max(thread.scan.brightest, brightest_of(meaning_.attributes[color], thread.columns));
  });

  Scan all;
  for (const Thread& thread : threads) {
    for (std::size_t a = 0; a < 3; ++a) all.axes[a].merge(thread.scan.axes[a]);
    all.brightest = std::max(all.brightest, thread.scan.brightest);
  }
  std::uint64_t rows = 0;
  for (std::size_t b = 0; b < blocks_.size(); ++b) {
    blocks_[b].first = info_.point_count;
    info_.point_count += blocks_[b].points;
    rows += table_->rows(b);
  }
  info_.dropped_points = rows - info_.point_count;
  if (info_.dropped_points > 0)
    info_.warnings.push_back(
        fmt::format("{} of {} points have no finite position; they are left out.", info_.dropped_points, rows));

  const ChosenGrid chosen = choose_grid(all.axes);
  info_.grid = chosen.grid;
  info_.stated_bounds = box_of(all.axes);
  if (chosen.largest_rounding > 0.0)
    info_.warnings.push_back(
        fmt::format("No grid of 32 bits holds all coordinates exactly; on steps of {} they move by up to {}.",
                    text_of(chosen.grid.scale), chosen.largest_rounding));
  for (const Derivation& from : meaning_.attributes)
    if (from.kind == Derivation::Kind::color) {
      const ScalarType type = fields[from.parts[0].field].type;
      depth_ =
          colors.empty() ? depth_of(type) : depth_of(all.brightest, type != ScalarType::f32 && type != ScalarType::f64);
    }
}

void TableSource::fill_batch(std::size_t block, std::span<const std::size_t> attributes, Workspace& workspace) const {
  workspace.columns.decode(block);
  load_positions(meaning_, workspace.columns, table_->rows(block), workspace.positions);
  const BlockPositions& positions = workspace.positions;
  PointBatch& batch = workspace.batch;
  if (positions.size() != blocks_[block].points)
    throw Error(fmt::format("{}: the file changed while it was read. Open it again when it is complete.", info_.path));
  batch.first = blocks_[block].first;
  batch.positions.resize(positions.size());
  positions.put_on_grid(info_.grid, batch.positions);
  for (std::size_t a = 0; a < attributes.size(); ++a) {
    derive(meaning_.attributes[attributes[a]], depth_, workspace.columns, batch.columns[a]);
    positions.compact(batch.columns[a]);
  }
}

void TableSource::read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const {
  std::vector<Column> empty_columns;
  for (const std::size_t index : attributes) empty_columns.push_back({info_.schema.at(index), {}});
  const std::vector<std::size_t> fields = fields_of(meaning_, attributes);
  tbb::enumerable_thread_specific<Workspace> workspaces([&] {
    return Workspace{FieldColumns(*table_, fields), {}, {0, {}, empty_columns}};
  });
  for_each_block(blocks_.size(), [&](std::size_t block) {
    if (blocks_[block].points == 0) return;
    Workspace& workspace = workspaces.local();
    fill_batch(block, attributes, workspace);
    // A consumer that waits for tasks of its own must not be handed another batch in the workspace it still reads.
    tbb::this_task_arena::isolate([&] { consume(workspace.batch); });
  });
}

}  // namespace stipple
