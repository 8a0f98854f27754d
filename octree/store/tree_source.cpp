#include "octree/store/tree_source.h"

#include <fmt/format.h>
#include <tbb/enumerable_thread_specific.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>

#include <algorithm>
#include <atomic>
#include <utility>

#include "octree/core/error.h"

namespace stipple {

TreeSource::TreeSource(std::shared_ptr<const TreeStore> store)
    : store_(std::move(store)),
      info_(store_->info().source),
      nodes_(in_store_order(*store_, locate_all(*store_, read_whole_hierarchy(*store_)))) {
  std::uint64_t points = 0;
  for (const StoredNode& node : nodes_) {
    first_.push_back(points);
    points += node.points;
  }
  // A compressed node can claim any number of points until it is unpacked: what is about to be allocated for them has
  // to be in the metadata, too.
  if (points > info_.point_count)
    throw Error(fmt::format("{}: the nodes hold {} points, and the metadata state {}. `stipple check` says more.",
                            info_.path, points, info_.point_count));
  if (points < info_.point_count)
    info_.warnings.push_back(
        fmt::format("the metadata state {} points, and the nodes hold {}", info_.point_count, points));
  info_.point_count = points;
}

void TreeSource::read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const {
  tbb::enumerable_thread_specific<PointBatch> batches;
  // Tasks split the work from its ends; a shared counter makes the disk see it from front to back.
  std::atomic<std::size_t> next{0};
  tbb::parallel_for(std::size_t{0}, nodes_.size(), [&](std::size_t) {
    const std::size_t index = next.fetch_add(1);
    PointBatch& batch = batches.local();
    batch.first = first_[index];
    store_->read_points(nodes_[index], attributes, batch);
    // A consumer that waits for tasks of its own must not be handed another batch in the memory it still reads
    tbb::this_task_arena::isolate([&] { consume(batch); });
  });
}

const StoredNode& TreeSource::node_of(std::uint64_t id) const {
  const auto after = std::upper_bound(first_.begin(), first_.end(), id);
  return nodes_.at(static_cast<std::size_t>(after - first_.begin()) - 1);
}

}  // namespace stipple
