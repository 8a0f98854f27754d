// A city as a tree on disk, and disks that fail.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <utility>

#include "octree/build/stream/tree_builder.h"
#include "octree/core/error.h"
#include "octree/open/open.h"
#include "src/scene/scene.h"
#include "tests/octree/las_fixture.h"
#include "tests/render/gl_test.h"

namespace stipple::test {

inline constexpr std::uint64_t kCityPoints = 60'000;

// The city as a tree of small nodes and clusters, made once.
inline const Dataset& city(bool loaded) {
  static const ScratchFolder folder;
  static const std::string path = [] {
    std::vector<std::unique_ptr<PointSource>> sources;
    sources.push_back(make_scene("city", kCityPoints, 1));
    StreamOptions options;
    options.leaf_capacity = 2'000;
    options.cluster_points = 300;
    BuildMonitor monitor;
    build_tree(sources, folder.path("tree"), options, monitor);
    return folder.path("tree");
  }();
  static const Dataset in_memory = open_dataset(path, "", {});
  static const Dataset on_disk = open_dataset(path, "", {.points = false});
  return loaded ? in_memory : on_disk;
}

inline View view_of_city(const char* camera) {
  return view_of(city(true), camera);
}

class FaultyTree final : public TreeStore {
 public:
  // Whether the n-th reading of the same part of this node fails.
  using Rule = std::function<bool(const StoredNode&, int n)>;

  FaultyTree(std::shared_ptr<const TreeStore> tree, Rule points_fail, Rule details_fail = {})
      : tree_(std::move(tree)), points_fail_(std::move(points_fail)), details_fail_(std::move(details_fail)) {}

  const TreeInfo& info() const override { return tree_->info(); }
  HierarchyPiece root_piece() const override { return tree_->root_piece(); }
  HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const override {
    return tree_->read_piece(where, parent);
  }
  StoredNode locate(const StoredNode& node) const override { return tree_->locate(node); }
  bool reads_parts() const override { return tree_->reads_parts(); }
  NodeDetails read_details(const StoredNode& node) const override {
    fail(node, kDetails, details_fail_);
    return tree_->read_details(node);
  }
  void read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const override {
    read_part(node, 0, node.points, attributes, batch);
  }
  void read_part(const StoredNode& node, std::uint64_t first, std::uint64_t count,
                 std::span<const std::size_t> attributes, PointBatch& batch) const override {
    fail(node, first, points_fail_);
    tree_->read_part(node, first, count, attributes, batch);
  }

 private:
  static constexpr std::uint64_t kDetails = ~std::uint64_t{0};

  void fail(const StoredNode& node, std::uint64_t first, const Rule& rule) const {
    if (!rule) return;
    int n = 0;
    {
      const std::lock_guard lock(mutex_);
      n = ++reads_[{name_of(node), first}];
    }
    if (rule(node, n)) throw Error(name_of(node) + ": the disk is gone");
  }

  std::shared_ptr<const TreeStore> tree_;
  Rule points_fail_;
  Rule details_fail_;
  mutable std::mutex mutex_;
  mutable std::map<std::pair<std::string, std::uint64_t>, int> reads_;
};

}  // namespace stipple::test
