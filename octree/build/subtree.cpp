#include "octree/build/subtree.h"

#include <algorithm>
#include <array>

#include "octree/build/box_count.h"
#include "octree/build/hash.h"
#include "octree/build/sampling.h"
#include "octree/build/sort.h"

namespace stipple {
namespace {

// Fisher-Yates. The rank of the cluster's first point, which no other cluster has, names its stream.
void shuffle(std::span<std::uint32_t> ids, std::uint64_t seed, std::uint32_t rank) {
  Random random(seed, rank);
  for (auto left = static_cast<std::uint32_t>(ids.size()); left > 1; --left)
    std::swap(ids[left - 1], ids[random.below(left)]);
}

Cluster append_cluster(Buffer<std::uint32_t>& order, std::span<const CodedPoint> points, const PositionView& positions,
                       std::uint64_t seed) {
  Cluster cluster;
  cluster.first = static_cast<std::uint32_t>(order.size());
  cluster.count = static_cast<std::uint32_t>(points.size());
  cluster.profile = box_counts(points);
  for (const CodedPoint& point : points) {
    cluster.box.extend(positions[point.id]);
    order.push_back(point.id);
  }
  shuffle(std::span(order).last(points.size()), seed, points.front().rank);
  return cluster;
}

class ChunkTreeBuilder {
 public:
  ChunkTreeBuilder(const Chunk& chunk, std::span<CodedPoint> points, const BuildOptions& options)
      : options_(options), points_(points), scratch_(points.size()), level_(points.size()), owner_(points.size()) {
    result_.chunk = chunk;
  }

  ChunkTree run(const PositionView& positions) {
    sort_points(points_, scratch_, result_.chunk.level);
    sample_levels(points_, level_);
    lowest_ =
        std::min_element(points_.begin(), points_.end(), [](const auto& a, const auto& b) { return a.rank < b.rank; }) -
        points_.begin();
    result_.lowest = points_[lowest_];
    grow(result_.chunk.level, 0, points_.size(), Node::kNone);
    group_by_owner();
    const std::size_t risen = result_.chunk.level == 0 ? 0 : result_.risen_end[result_.chunk.level - 1];
    result_.risen.assign(scratch_.begin(), scratch_.begin() + risen);
    result_.tree.order.reserve(points_.size() - risen);
    std::size_t first = risen;
    std::vector<Node> nodes = std::move(result_.tree.nodes);
    result_.tree.nodes.clear();
    for (const Node& node : nodes) {
      append_node(result_.tree, node, std::span(scratch_).subspan(first, node.count), positions, options_);
      first += node.count;
    }
    return std::move(result_);
  }

 private:
  // Adds the node that covers points [first, last), and those below it, counting what each will hold.
  void grow(int level, std::size_t first, std::size_t last, std::uint32_t parent) {
    std::vector<Node>& nodes = result_.tree.nodes;
    const auto index = static_cast<std::uint32_t>(nodes.size());
    Node& node = nodes.emplace_back();
    node.parent = parent;
    node.level = level;
    node.cell = morton_decode(points_[first].code >> bits_below(level));
    path_[level] = index;
    if (last - first <= options_.leaf_capacity || points_[first].code == points_[last - 1].code) {
      for (std::size_t i = first; i < last; ++i) assign(i, level);
      return;
    }
    for (std::size_t begin = first; begin < last;) {
      const std::uint64_t cell = points_[begin].code >> bits_below(level + 1);
      const auto end = std::partition_point(points_.begin() + begin, points_.begin() + last, [&](const CodedPoint& p) {
        return p.code >> bits_below(level + 1) == cell;
      });
      const std::size_t next = end - points_.begin();
      grow(level + 1, begin, next, index);
      begin = next;
    }
  }

  // Point i is below or in the leaf of `leaf_level` on the path: its node is the one it was sampled for, or the leaf.
  void assign(std::size_t i, int leaf_level) {
    const int level = std::min<int>(level_[i], leaf_level);
    if (level >= result_.chunk.level) {
      owner_[i] = result_.chunk.level + path_[level];
      ++result_.tree.nodes[path_[level]].count;
    } else if (i == lowest_) {
      owner_[i] = kLowest;
    } else {
      owner_[i] = static_cast<std::uint32_t>(level);
      ++result_.risen_end[level];
    }
  }

  // Fills scratch with the points of one owner after the other, each in ascending order of code.
  void group_by_owner() {
    std::vector<std::size_t> next;
    std::uint32_t first = 0;
    for (int level = 0; level < result_.chunk.level; ++level) {
      next.push_back(first);
      first = result_.risen_end[level] += first;
    }
    for (const Node& node : result_.tree.nodes) {
      next.push_back(first);
      first += node.count;
    }
    for (std::size_t i = 0; i < points_.size(); ++i)
      if (owner_[i] != kLowest) scratch_[next[owner_[i]]++] = points_[i];
  }

  static constexpr std::uint32_t kLowest = Node::kNone;  // no owner yet

  const BuildOptions& options_;
  std::span<CodedPoint> points_;
  Buffer<CodedPoint> scratch_;
  Buffer<std::uint8_t> level_;   // that each point was sampled for
  Buffer<std::uint32_t> owner_;  // of each point: a level above the chunk, or the chunk's level plus a node's number
  std::size_t lowest_ = 0;       // point of lowest rank
  std::array<std::uint32_t, kMaxLevel + 1> path_{};  // node on each level down to the one at work
  ChunkTree result_;
};

}  // namespace

void append_node(Subtree& tree, Node node, std::span<const CodedPoint> own, const PositionView& positions,
                 const BuildOptions& options) {
  const std::size_t half = options.cluster_points / 2;
  const std::size_t clusters = own.empty() ? 0 : std::max<std::size_t>(1, (own.size() + half) / options.cluster_points);
  node.first = static_cast<std::uint32_t>(tree.order.size());
  node.count = static_cast<std::uint32_t>(own.size());
  node.first_cluster = static_cast<std::uint32_t>(tree.clusters.size());
  node.cluster_count = static_cast<std::uint32_t>(clusters);
  node.profile = box_counts(own);
  for (std::size_t c = 0; c < clusters; ++c) {
    const std::size_t first = own.size() * c / clusters;
    const std::size_t last = own.size() * (c + 1) / clusters;
    tree.clusters.push_back(append_cluster(tree.order, own.subspan(first, last - first), positions, options.seed));
    node.box.extend(tree.clusters.back().box);
  }
  tree.nodes.push_back(node);
}

ChunkTree build_chunk_tree(const Chunk& chunk, std::span<CodedPoint> points, const PositionView& positions,
                           const BuildOptions& options) {
  return ChunkTreeBuilder(chunk, points, options).run(positions);
}

}  // namespace stipple
