#include "octree/build/stream/region_builder.h"

#include <algorithm>
#include <atomic>
#include <memory>
#include <vector>

#include "octree/build/stream/distribute.h"
#include "octree/build/stream/in_order.h"
#include "octree/store/potree2/node_encoder.h"

namespace stipple {
namespace {

constexpr std::size_t kSmallestBuffer = std::size_t{1} << 14;  // of a part while spilling, bytes
constexpr std::size_t kSpillBuffers = std::size_t{1} << 25;    // of all parts, bytes: as many parts as a cloud may have
constexpr std::size_t kMostParts = kSpillBuffers / kSmallestBuffer;

// Copies all records of a region chunk after chunk into `to`, in any order inside one.
void gather(const Region& region, const CellMap& map, const BuildSetup& setup, BuildMonitor& monitor,
            std::span<std::byte> to) {
  const Quantizer quantizer(setup.frame.grid, setup.frame.bounds);
  std::vector<std::atomic<std::uint64_t>> next(map.parts().size());
  for (std::size_t c = 0; c < next.size(); ++c) next[c] = map.parts()[c].first * setup.record_bytes;
  struct Workspace {
    Distributor distributor;
    std::vector<std::byte*> place;
  };
  tbb::enumerable_thread_specific<Workspace> workspaces([&] {
    return Workspace{{map, quantizer, setup.record_bytes}, std::vector<std::byte*>(map.parts().size())};
  });
  region.read_records([&](std::span<const std::byte> records) {
    auto& [distributor, place] = workspaces.local();
    distributor.assign(records);
    for (const std::uint32_t part : distributor.touched())
      place[part] = to.data() + next[part].fetch_add(distributor.count(part) * setup.record_bytes);
    distributor.scatter(records, place);
    monitor.add_points(BuildPhase::distributing, records.size() / setup.record_bytes);
  });
}

// Appends each record of a region to its part.
void spill(const Region& region, const CellMap& map, const BuildSetup& setup, BuildMonitor& monitor,
           std::span<const std::unique_ptr<SpilledPart>> parts) {
  const Quantizer quantizer(setup.frame.grid, setup.frame.bounds);
  struct Workspace {
    Distributor distributor;
    std::vector<std::byte*> place;
    Buffer<std::byte> sorted;
  };
  tbb::enumerable_thread_specific<Workspace> workspaces([&] {
    return Workspace{{map, quantizer, setup.record_bytes}, std::vector<std::byte*>(parts.size()), {}};
  });
  region.read_records([&](std::span<const std::byte> records) {
    auto& [distributor, place, sorted] = workspaces.local();
    distributor.assign(records);
    sorted.resize(records.size());
    std::byte* at = sorted.data();
    for (const std::uint32_t part : distributor.touched()) {
      place[part] = at;
      at += distributor.count(part) * setup.record_bytes;
    }
    distributor.scatter(records, place);
    for (const std::uint32_t part : distributor.touched()) {
      const std::size_t bytes = distributor.count(part) * setup.record_bytes;
      parts[part]->append({place[part] - bytes, bytes});
    }
    monitor.add_points(BuildPhase::distributing, records.size() / setup.record_bytes);
  });
  for (const auto& part : parts) part->close();
}

}  // namespace

// A chunk on its way: what is finished with it, and where that goes.
struct RegionBuilder::Work {
  Chunk chunk;
  OpenNode top;
  potree2::PackedNodes below, above;
  std::uint64_t below_place = 0, above_place = 0;
};

RegionBuilder::RegionBuilder(const BuildSetup& setup, SpillFile& spill, potree2::TreeWriter& writer,
                             BuildMonitor& monitor)
    : setup_(setup),
      spill_(spill),
      writer_(writer),
      monitor_(monitor),
      upper_(setup.options, setup.frame, setup.record_bytes),
      chunk_builders_([this] { return ChunkBuilder(setup_.options, setup_.frame, setup_.record_bytes); }) {}

void RegionBuilder::build(const Region& region, CellMap& map) {
  if (region.points * setup_.record_bytes <= setup_.plan.region_bytes)
    build_in_memory(region, map);
  else
    build_parts(region, map);
}

void RegionBuilder::build_in_memory(const Region& region, CellMap& map) {
  while (map.refine(setup_.options.chunk_points)) map.count(region.read_codes);
  const std::vector<Chunk>& chunks = map.divide(setup_.options.chunk_points);
  monitor_.begin(BuildPhase::distributing);
  gather(region, map, setup_, monitor_, records_.reserve(region.points * setup_.record_bytes));
  monitor_.begin(BuildPhase::building);
  build_chunks(chunks);
}

void RegionBuilder::build_chunks(std::span<const Chunk> chunks) {
  const auto grow = [&](std::size_t index) {
    auto work = std::make_unique<Work>();
    work->chunk = chunks[index];
    const Chunk& chunk = work->chunk;
    const auto records = records_.bytes().subspan(chunk.first * setup_.record_bytes, chunk.count * setup_.record_bytes);
    BuiltChunk built = chunk_builders_.local().build({chunk.level, chunk.code}, records);
    work->top = std::move(built.top);
    work->below = std::move(built.below);
    encode(work->below);
    return work;
  };
  const std::size_t in_flight = static_cast<std::size_t>(setup_.plan.threads) * 3 / 2 + 1;
  in_order<Work>(
      chunks.size(), in_flight, grow, [&](Work& work) { place(work); }, [&](const Work& work) { write(work); });
}

void RegionBuilder::encode(potree2::PackedNodes& packed) const {
  if (setup_.options.encoding == potree2::Encoding::brotli) potree2::encode_brotli(packed, setup_.schema);
}

void RegionBuilder::place(Work& work) {
  work.below_place = writer_.place(work.below);
  upper_.add(std::move(work.top), work.above);
  encode(work.above);
  work.above_place = writer_.place(work.above);
}

void RegionBuilder::write(const Work& work) {
  write_packed(work.below_place, work.below);
  write_packed(work.above_place, work.above);
  monitor_.add_points(BuildPhase::building, work.chunk.count);
}

void RegionBuilder::write_packed(std::uint64_t place, const potree2::PackedNodes& packed) {
  if (packed.nodes.empty()) return;
  writer_.write(place, packed.bytes);
  monitor_.add_written(packed.bytes.size());
  if (!monitor_.on_finished) return;
  std::vector<FinishedNode> finished;
  for (const potree2::PackedNodes::PackedNode& node : packed.nodes) {
    finished.push_back(
        {node.level, morton_decode(node.code >> bits_below(node.level)), node.points, place, node.bytes, node.box});
    place += node.bytes;
  }
  monitor_.on_finished({writer_.points_path(), finished});
}

std::vector<std::unique_ptr<SpilledPart>> RegionBuilder::spill_parts(const Region& region, const CellMap& map) {
  const std::size_t count = map.parts().size();
  const std::size_t room = std::min<std::size_t>(kSpillBuffers, setup_.plan.spill_bytes) / count;
  const std::size_t buffer = std::max<std::size_t>(1, room / setup_.record_bytes) * setup_.record_bytes;
  records_.release();
  Buffer<std::byte> buffers(count * buffer);
  std::vector<std::unique_ptr<SpilledPart>> parts;
  for (std::size_t p = 0; p < count; ++p)
    parts.push_back(std::make_unique<SpilledPart>(spill_, std::span(buffers).subspan(p * buffer, buffer)));
  monitor_.begin(BuildPhase::distributing);
  spill(region, map, setup_, monitor_, parts);
  return parts;
}

void RegionBuilder::build_parts(const Region& region, CellMap& map) {
  std::uint64_t capacity = setup_.plan.part_bytes / setup_.record_bytes;
  while (map.refine(capacity)) map.count(region.read_codes);
  map.divide(capacity);
  const std::size_t most = std::min<std::size_t>(kMostParts, setup_.plan.spill_bytes / kSmallestBuffer);
  while (map.parts().size() > most && capacity * 2 < region.points) map.divide(capacity *= 2);
  const std::vector<Chunk> cells = map.parts();
  if (cells.size() == 1 && cells.front().count == region.points) return build_heap(region);
  const std::vector<std::unique_ptr<SpilledPart>> parts = spill_parts(region, map);
  const Quantizer quantizer(setup_.frame.grid, setup_.frame.bounds);
  for (std::size_t p = 0; p < cells.size(); ++p) {
    Region part{{cells[p].level, cells[p].code}, cells[p].count, {}, {}};
    part.read_records = [&](const RecordConsumer& consume) { parts[p]->read(consume); };
    part.read_codes = [&](const CodeConsumer& consume) {
      parts[p]->read([&](std::span<const std::byte> records) {
        for_each_code_block(
            records.size() / setup_.record_bytes, quantizer,
            [&](std::size_t i) { return position_of(records.data() + i * setup_.record_bytes); },
            [&](std::size_t, std::span<const std::uint64_t> codes) { consume(codes); });
      });
    };
    CellMap part_map(part.cell.level, part.cell.code);
    part_map.count(part.read_codes);
    build(part, part_map);
    parts[p]->discard();
  }
}

void RegionBuilder::finish() {
  Work work;
  upper_.finish(work.above);
  encode(work.above);
  work.above_place = writer_.place(work.above);
  write(work);
}

}  // namespace stipple
