// A whole octree on disk as a source of points.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "octree/cloud/source.h"
#include "octree/store/tree_store.h"

namespace stipple {

// Points in store order: node after node as they stand in the file. Their ids count in that order.
class TreeSource : public PointSource {
 public:
  // Reads the whole hierarchy and locates its nodes. info() states the points that the nodes hold; where the metadata
  // state another number, a warning says so. Throws Error when the hierarchy contradicts itself, or holds more points
  // than the metadata state.
  explicit TreeSource(std::shared_ptr<const TreeStore> store);

  const SourceInfo& info() const override { return info_; }

  // A batch a node, begun in file order.
  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override;

  // In store order; located, with points.
  const std::vector<StoredNode>& nodes() const { return nodes_; }
  // The node that holds the point; `id` is below info().point_count.
  const StoredNode& node_of(std::uint64_t id) const;

 private:
  std::shared_ptr<const TreeStore> store_;
  SourceInfo info_;
  std::vector<StoredNode> nodes_;     // in store order
  std::vector<std::uint64_t> first_;  // id of the first point of each
};

}  // namespace stipple
