#include "render/store/tree_supply.h"

#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>

#include "render/store/tree_ids.h"
#include "tests/supply/plane_tree.h"

namespace stipple::test::supply_tree_supply {
namespace {

// Every node in sight looked up, as frames would.
void finish(TreeSupply& supply) {
  while (supply.searching()) {
    supply.discovered();
    supply.collect(0);
  }
}

// All that is in sight, requested as it becomes known.
std::uint64_t points_read(TreeSupply& supply) {
  std::uint64_t requested = 0, read = 0;
  while (supply.searching() || read < requested) {
    for (const VisibleCluster& cluster : supply.discovered()) {
      supply.request(cluster.handle, 0, cluster.count, false);
      requested += cluster.count;
    }
    for (const PointPiece& piece : supply.collect(1000)) read += piece.count;
  }
  return read;
}

std::unique_ptr<TreeSupply> supply_of(const std::string& folder) {
  return std::make_unique<TreeSupply>(open_tree(folder), ColorMap{.attribute = "height"});
}

TEST(TreeSupplyOnDisk, ANarrowViewReadsThePiecesInSight) {
  const ScratchFolder folder;
  Potree1Files files;
  files.tree = plane_tree(5);
  files.version = "1.8";
  files.step_size = 2;
  const auto supply = supply_of(files.write(folder));
  // 16 pieces begin on level 2, 256 on level 4
  supply->visible(from_above(kPlaneCube, 0.01, kPlace));
  finish(*supply);
  EXPECT_GE(supply->pieces_read(), 2u);
  EXPECT_LE(supply->pieces_read(), 8u);
  const std::uint64_t narrow = supply->pieces_read();
  // The same again: all of it is known
  EXPECT_FALSE(supply->visible(from_above(kPlaneCube, 0.01, kPlace)).empty());
  EXPECT_FALSE(supply->searching());
  EXPECT_EQ(supply->pieces_read(), narrow);
  supply->visible(from_above(kPlaneCube, 3.0, kPlace));
  finish(*supply);
  EXPECT_EQ(supply->pieces_read(), 16u + 256u);
}

TEST(TreeSupplyOnDisk, MovingOnForgetsWhatWasNotBegun) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree = plane_tree(4);
  const auto supply = supply_of(files.write(folder));
  for (int i = 0; i < 200; ++i) {
    supply->visible(from_above(kPlaneCube, i % 2 ? 3.0 : 0.05, kPlace + 0.001 * glm::dvec2(i, -i)));
    if (i % 3 == 0) supply->discovered();
  }
  std::size_t points = 0;
  const View all = from_above(kPlaneCube, 4.0, {0.5, 0.5});
  for (const VisibleCluster& cluster : supply->visible(all)) points += cluster.count;
  while (supply->searching()) {
    for (const VisibleCluster& cluster : supply->discovered()) points += cluster.count;
    supply->collect(0);
  }
  EXPECT_EQ(points, files.tree.points());
  EXPECT_EQ(supply->visible_nodes(), files.tree.nodes.size());
}

// Stands for a disk that does not answer until it is let.
class GatedStore : public TreeStore {
 public:
  explicit GatedStore(std::unique_ptr<TreeStore> store) : store_(std::move(store)) {}

  const TreeInfo& info() const override { return store_->info(); }
  HierarchyPiece root_piece() const override { return store_->root_piece(); }
  HierarchyPiece read_piece(const HierarchyPiece::Continuation& where, const StoredNode& parent) const override {
    pass();
    return store_->read_piece(where, parent);
  }
  StoredNode locate(const StoredNode& node) const override {
    pass();
    return store_->locate(node);
  }
  void read_points(const StoredNode& node, std::span<const std::size_t> attributes, PointBatch& batch) const override {
    pass();
    store_->read_points(node, attributes, batch);
  }
  bool reads_parts() const override { return store_->reads_parts(); }

  void open() {
    const std::lock_guard lock(mutex_);
    open_ = true;
    opened_.notify_all();
  }

 private:
  void pass() const {
    std::unique_lock lock(mutex_);
    opened_.wait(lock, [this] { return open_; });
  }

  std::unique_ptr<TreeStore> store_;
  mutable std::mutex mutex_;
  mutable std::condition_variable opened_;
  bool open_ = false;
};

TEST(TreeSupplyOnDisk, NothingWaitsForTheDisk) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree = plane_tree(3);
  const auto store = std::make_shared<GatedStore>(open_tree(files.write(folder)));
  TreeSupply supply(store, ColorMap{.attribute = "height"});
  const View view = from_above(kPlaneCube, 3.0, kPlace);
  const auto start = std::chrono::steady_clock::now();
  EXPECT_TRUE(supply.visible(view).empty());
  for (int frame = 0; frame < 10; ++frame) {
    EXPECT_TRUE(supply.discovered().empty());
    EXPECT_TRUE(supply.collect(100'000).empty());
  }
  // Ten times the patience for which a frame may hope, and a slow machine
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_TRUE(supply.searching());
  store->open();
  EXPECT_EQ(points_read(supply), files.tree.points());
}

TEST(TreeSupplyOnDisk, APieceThatCannotBeReadIsMissedByTheViewThatSeesIt) {
  const ScratchFolder folder;
  Potree1Files files;
  files.version = "1.8";
  files.write(folder);
  std::filesystem::remove(folder.path("data/r/7/r7.hrc"));
  const auto supply = supply_of(folder.path(""));
  // Child 0 is at the low corner, child 7 at the high one
  supply->visible(from_above(kPlaneCube, 0.2, {0.25, 0.25}));
  finish(*supply);
  EXPECT_EQ(supply->unread().parts, 0u);
  supply->visible(from_above(kPlaneCube, 0.2, {0.75, 0.75}));
  finish(*supply);
  EXPECT_EQ(supply->unread().parts, 1u);
  EXPECT_TRUE(contains(supply->unread().message(), "data/r/7/r7.hrc: there is no such file"));
  supply->visible(from_above(kPlaneCube, 0.2, {0.25, 0.25}));
  EXPECT_EQ(supply->unread().parts, 0u);
}

TEST(TreeSupplyOnDisk, APieceThatLeadsBackIsAnErrorNotATreeWithoutEnd) {
  const ScratchFolder folder;
  TreeFiles files = TreeFiles::usual();
  files.nodes["r"].clear();
  files.write(folder);
  Bytes hierarchy = files.hierarchy();
  // The proxy of child 0 leads to the root's piece
  put(hierarchy, 22 + 6, std::uint64_t{0});
  put(hierarchy, 22 + 14, std::uint64_t{88});
  folder.write("hierarchy.bin", hierarchy);
  EXPECT_TRUE(contains(error_of([&] { read_whole_hierarchy(*open_tree(folder.path(""))); }), "of another piece"));
  const auto supply = supply_of(folder.path(""));
  supply->visible(from_above(kPlaneCube, 4.0, {0.5, 0.5}));
  finish(*supply);
  EXPECT_TRUE(contains(supply->unread().first, "of another piece"));
}

TEST(TreeSupplyOnDisk, EveryNodeHasIdsOfItsOwn) {
  std::set<std::uint32_t> ids;
  StoredNode node;
  node.points = 1000;
  for (node.level = 0; node.level < 6; ++node.level)
    for (node.cell.x = 0; node.cell.x < 1u << node.level; ++node.cell.x)
      for (node.cell.y = 0; node.cell.y < 1u << node.level; ++node.cell.y) ids.insert(first_id_of(node));
  EXPECT_EQ(ids.size(), 1365u);
  EXPECT_LT(*ids.rbegin(), kNoPoint - 1000);
  node.points = kNoPoint - 1;
  EXPECT_EQ(first_id_of(node), 0u);
  node.points = kNoPoint;
  EXPECT_TRUE(contains(error_of([&] { first_id_of(node); }), "ids of 32 bits"));
}

}  // namespace
}  // namespace stipple::test::supply_tree_supply
