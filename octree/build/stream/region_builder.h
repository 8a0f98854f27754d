// Builds the part of a tree below one cell: in memory when its points fit, else by spilling them to disk in parts, each
// of which is built in turn. Source of the idea: Schuetz, Ohrhallinger, Wimmer, "Fast Out-of-Core Octree Generation for
// Massive Point Clouds", 2020, section 3.
#pragma once

#include <tbb/enumerable_thread_specific.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "octree/build/stream/cell_map.h"
#include "octree/build/stream/chunk_builder.h"
#include "octree/build/stream/inputs.h"
#include "octree/build/stream/memory_plan.h"
#include "octree/build/stream/monitor.h"
#include "octree/build/stream/options.h"
#include "octree/build/stream/record_block.h"
#include "octree/build/stream/spill.h"
#include "octree/build/stream/upper_levels.h"
#include "octree/store/potree2/writer.h"

namespace stipple {

// A cell's points wherever they are.
struct Region {
  CellId cell;
  std::uint64_t points = 0;
  CodeFeed read_codes;                                      // may be called again and again
  std::function<void(const RecordConsumer&)> read_records;  // in memory: called once. Else also again and again
};

struct BuildSetup {
  StreamOptions options;  // chunk_points as chunk_points() says
  CubeFrame frame;
  Schema schema;
  std::size_t record_bytes = 0;  // of the schema
  MemoryPlan plan;
};

class RegionBuilder {
 public:
  RegionBuilder(const BuildSetup& setup, SpillFile& spill, potree2::TreeWriter& writer, BuildMonitor& monitor);

  // `map` is of the region's cell and has been counted once or more. Regions are built in Morton order.
  void build(const Region& region, CellMap& map);
  // After the last region.
  void finish();

 private:
  struct Work;

  void build_in_memory(const Region& region, CellMap& map);
  void build_chunks(std::span<const Chunk> chunks);
  void build_parts(const Region& region, CellMap& map);
  std::vector<std::unique_ptr<SpilledPart>> spill_parts(const Region& region, const CellMap& map);
  // All points have one code and are too many for memory: they become a leaf in the order in which they stand.
  void build_heap(const Region& region);
  void encode(potree2::PackedNodes& packed) const;
  void place(Work& work);
  void write(const Work& work);
  void write_packed(std::uint64_t place, const potree2::PackedNodes& packed);

  const BuildSetup& setup_;
  SpillFile& spill_;
  potree2::TreeWriter& writer_;
  BuildMonitor& monitor_;
  UpperLevels upper_;
  RecordBlock records_;
  tbb::enumerable_thread_specific<ChunkBuilder> chunk_builders_;
};

}  // namespace stipple
