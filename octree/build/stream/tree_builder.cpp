#include "octree/build/stream/tree_builder.h"

#include <fmt/format.h>
#include <malloc.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <filesystem>

#include "octree/build/stream/distribute.h"
#include "octree/build/stream/region_builder.h"
#include "octree/core/error.h"
#include "octree/core/stopwatch.h"
#include "octree/store/potree2/writer_folder.h"

namespace stipple {
namespace {

void check(const StreamOptions& options) {
  if (options.leaf_capacity == 0 || options.cluster_points == 0 || options.chunk_points == 0)
    throw Error("leaf capacity, cluster size and chunk size of an octree must be 1 point or more");
  if (options.memory < kLeastMemory)
    throw Error(fmt::format("{} bytes of memory are too little: a build takes {} MiB or more", options.memory,
                            kLeastMemory >> 20));
}

CodeFeed code_feed(Inputs& inputs) {
  return [&inputs](const CodeConsumer& consume) {
    const Quantizer quantizer(inputs.grid(), inputs.bounds());
    const bool right = inputs.read_positions([&](std::span<const glm::ivec3> positions) {
      for_each_code_block(
          positions.size(), quantizer, [&](std::size_t i) { return positions[i]; },
          [&](std::size_t, std::span<const std::uint64_t> codes) { consume(codes); });
    });
    if (!right) throw changed_while_read();
  };
}

// Counts all points in the cells of their cube, which is known only then: headers give it, nearly always rightly.
CellMap first_count(Inputs& inputs) {
  CellMap map(0, 0);
  read_until_right([&] {
    map = CellMap(0, 0);
    const Quantizer quantizer(inputs.grid(), inputs.bounds());
    bool right = false;
    map.count([&](const CodeConsumer& consume) {
      right = inputs.read_positions([&](std::span<const glm::ivec3> positions) {
        for_each_code_block(
            positions.size(), quantizer, [&](std::size_t i) { return positions[i]; },
            [&](std::size_t, std::span<const std::uint64_t> codes) { consume(codes); });
      });
    });
    return right;
  });
  return map;
}

WorldBox box_of(const RootCube& cube) {
  return {cube.min, cube.min + cube.edge};
}

class TreeBuild {
 public:
  TreeBuild(std::span<const std::unique_ptr<PointSource>> sources, const std::string& target,
            const StreamOptions& options, BuildMonitor& monitor)
      : monitor_(monitor),
        inputs_(sources, monitor),
        plan_(plan_memory(options, inputs_.record_bytes())),
        threads_(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(plan_.threads)),
        stats_(inputs_.schema()),
        folder_(target, options.replace),
        writer_(folder_.path()),
        spill_(folder_.path(), monitor) {
    setup_.options = options;
    setup_.options.chunk_points = chunk_points(options, inputs_.record_bytes());
    setup_.schema = inputs_.schema();
    setup_.record_bytes = inputs_.record_bytes();
    setup_.plan = plan_;
  }

  BuildReport run() {
    monitor_.begin(BuildPhase::counting);
    CellMap map = first_count(inputs_);
    ::malloc_trim(0);  // the readers' batches
    setup_.frame = {inputs_.grid(), inputs_.bounds(), root_cube(inputs_.grid(), inputs_.bounds())};
    lap(BuildPhase::counting);
    build(map);
    lap(BuildPhase::building);
    monitor_.begin(BuildPhase::finishing);
    finish();
    lap(BuildPhase::finishing);
    return report_;
  }

 private:
  void build(CellMap& map) {
    RegionBuilder builder(setup_, spill_, writer_, monitor_);
    Region all{{}, inputs_.point_count(), code_feed(inputs_), {}};
    all.read_records = [this](const RecordConsumer& consume) {
      inputs_.read_records(stats_, consume);
      ::malloc_trim(0);
      lap(BuildPhase::distributing);
    };
    if (all.points > 0) builder.build(all, map);
    builder.finish();
  }

  void finish() {
    potree2::Metadata metadata;
    metadata.name = std::filesystem::path(folder_.target()).filename().string();
    metadata.points = inputs_.point_count();
    metadata.grid = setup_.frame.grid;
    metadata.spacing = spacing_of_level(setup_.frame.cube, 0);
    metadata.cube = box_of(setup_.frame.cube);
    metadata.encoding = setup_.options.encoding;
    metadata.schema = inputs_.schema();
    metadata.ranges = stats_.ranges();
    metadata.ranges.insert(metadata.ranges.begin(), inputs_.position_range());
    potree2::SidecarHeader sidecar;
    sidecar.sampling = static_cast<std::uint32_t>(setup_.options.sampling);
    sidecar.fraction = setup_.options.sampling == Sampling::poisson ? kPoissonFraction : 0.0;
    sidecar.points = metadata.points;
    sidecar.seed = setup_.options.seed;
    writer_.finish(metadata, sidecar);
    folder_.commit();
    const BuildProgress progress = monitor_.progress();
    report_.points = metadata.points;
    report_.nodes = writer_.nodes().size();
    report_.depth = metadata.depth;
    report_.spacing = metadata.spacing;
    report_.grid = metadata.grid;
    report_.largest_rounding = inputs_.largest_rounding();
    report_.bytes_read = progress.bytes_read;
    report_.bytes_spilled = spill_.bytes();
    report_.bytes_written = writer_.bytes_written() + spill_.bytes();
  }

  void lap(BuildPhase phase) { report_.phases.push_back({phase, stopwatch_.lap()}); }

  BuildMonitor& monitor_;
  Inputs inputs_;
  MemoryPlan plan_;
  tbb::global_control threads_;
  AttributeStats stats_;
  potree2::WriterFolder folder_;
  potree2::TreeWriter writer_;
  SpillFile spill_;
  BuildSetup setup_;
  Stopwatch stopwatch_;
  BuildReport report_;
};

}  // namespace

BuildReport build_tree(std::span<const std::unique_ptr<PointSource>> sources, const std::string& folder,
                       const StreamOptions& options, BuildMonitor& monitor) {
  check(options);
  keep_heap_small(options.memory);
  return TreeBuild(sources, folder, options, monitor).run();
}

}  // namespace stipple
