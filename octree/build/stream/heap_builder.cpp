// Heaps of points at one place that are larger than memory.
#include <fmt/format.h>
#include <tbb/task_arena.h>

#include <algorithm>

#include "octree/build/stream/record.h"
#include "octree/build/stream/region_builder.h"
#include "octree/core/error.h"

namespace stipple {
namespace {

// Cuts a stream of records into runs of `count` that do not depend on the batches they come in.
class RunCutter {
 public:
  RunCutter(std::size_t record_bytes, std::uint32_t count, std::uint64_t points)
      : record_bytes_(record_bytes), count_(count), left_(points) {}

  // Calls `extend` with each record and `end` with the number of points of each run that is complete.
  template <class Extend, class End>
  void add(std::span<const std::byte> records, const Extend& extend, const End& end) {
    for (std::size_t at = 0; at < records.size(); at += record_bytes_) {
      extend(position_of(records.data() + at));
      --left_;
      if (++filled_ < count_ && left_ > 0) continue;
      end(filled_);
      filled_ = 0;
    }
  }

 private:
  std::size_t record_bytes_;
  std::uint32_t count_;
  std::uint64_t left_;
  std::uint32_t filled_ = 0;
};

}  // namespace

void RegionBuilder::build_heap(const Region& region) {
  if (setup_.options.encoding == potree2::Encoding::brotli)
    throw Error(
        fmt::format("{} points stand at one place, and memory is too little to pack them as one node. Give it "
                    "more, or build with --encoding DEFAULT.",
                    region.points));
  monitor_.begin(BuildPhase::building);
  potree2::PackedNodes packed;
  potree2::PackedNodes::PackedNode node{region.cell.level,
                                        region.cell.code,
                                        static_cast<std::uint32_t>(region.points),
                                        0,
                                        region.points * setup_.record_bytes,
                                        {},
                                        {}};
  node.profile.occupied.fill(1);
  RunCutter cutter(setup_.record_bytes, static_cast<std::uint32_t>(setup_.options.cluster_points), region.points);
  Cluster cluster;
  cluster.profile = node.profile;
  // One thread reads, so that both passes see the same order
  tbb::task_arena alone(1);
  alone.execute([&] {
    region.read_records([&](std::span<const std::byte> records) {
      cutter.add(
          records, [&](const glm::ivec3& position) { cluster.box.extend(position); },
          [&](std::uint32_t count) {
            cluster.count = count;
            packed.clusters.push_back(cluster);
            node.box.extend(cluster.box);
            cluster.first += count;
            cluster.box = {};
          });
    });
  });
  node.clusters = static_cast<std::uint32_t>(packed.clusters.size());
  packed.nodes.push_back(node);
  std::uint64_t place = writer_.place(packed);
  alone.execute([&] {
    region.read_records([&](std::span<const std::byte> records) {
      writer_.write(place, records);
      place += records.size();
      monitor_.add_written(records.size());
      monitor_.add_points(BuildPhase::building, records.size() / setup_.record_bytes);
    });
  });
}

}  // namespace stipple
