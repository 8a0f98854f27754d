// What the hierarchical method finds out of a tree on disk, and when.
#include <gtest/gtest.h>

#include <array>
#include <chrono>
#include <condition_variable>
#include <mutex>
#include <set>
#include <thread>

#include "octree/build/stream/tree_builder.h"
#include "render/method/hierarchical.h"
#include "render/store/tree_ids.h"
#include "render/store/tree_supply.h"
#include "src/scene/scene.h"
#include "tests/octree/node_files.h"
#include "tests/render/gl_test.h"

namespace stipple::test {
namespace {

// A tree over a plane: four children a node, 60 points in each of its 5,461 nodes.
TreeFiles plane_tree(int depth = 6) {
  TreeFiles tree;
  std::vector<std::string> level{"r"};
  for (int d = 0; d <= depth; ++d) {
    std::vector<std::string> next;
    for (const std::string& name : level) {
      tree.nodes[name] = TreeFiles::points_in(name);
      for (const char child : {'0', '2', '4', '6'}) next.push_back(name + child);
    }
    level = next;
  }
  return tree;
}

// Straight down on a square whose edge is `share` of the cube's, around a place given in shares of its x and y, from so
// far above that height hardly matters.
View from_above(const RootCube& cube, double share, const glm::dvec2& place) {
  const double height = 100.0 * cube.edge;
  const glm::dvec3 target = cube.min + cube.edge * glm::dvec3(place, 0.0);
  Camera camera{.eye = target + glm::dvec3(0, 0, height), .target = target, .up = {0, 1, 0}};
  camera.fov_deg = glm::degrees(2.0 * std::atan(0.5 * share * cube.edge / height));
  return make_view(camera, {128, 128}, 1e-3 * cube.edge);
}

// Of the trees made here.
const RootCube kCube{{100.0, 200.0, 300.0}, 1024.0};
constexpr glm::dvec2 kPlace{0.437, 0.613};

bool is_in_sight(const View& view, const glm::dvec3& place) {
  const glm::dvec3 r = place - view.eye;
  const double depth = glm::dot(view.forward, r);
  return depth > view.near && std::abs(glm::dot(view.right, r)) * view.cot_x < depth &&
         std::abs(glm::dot(view.up, r)) * view.cot_y < depth;
}

double share_in_sight(const TreeStore& store, const View& view) {
  std::uint64_t seen = 0, all = 0;
  PointBatch batch;
  for (const StoredNode& node : locate_all(store, read_whole_hierarchy(store))) {
    store.read_points(node, {}, batch);
    all += batch.positions.size();
    for (const glm::ivec3& p : batch.positions) seen += is_in_sight(view, store.info().source.grid.world_from_grid(p));
  }
  return static_cast<double>(seen) / static_cast<double>(all);
}

std::uint64_t bytes_in(const std::string& folder) {
  std::uint64_t bytes = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) bytes += entry.file_size();
  return bytes;
}

// Draws the view from a tree that nobody has looked at; all that is read from disk counts, opening included.
void expect_to_read_little(const std::string& folder, const View& view) {
  const double seen = share_in_sight(*open_tree(folder), view);
  ASSERT_GT(seen, 0.005);
  ASSERT_LT(seen, 0.015);
  const Dataset dataset = open_dataset(folder, "", {.points = false, .octree = true});
  const auto method = make_method(Mode::hierarchical, dataset, {.largest_budget = 100'000});
  converged_picture(*method, RasterizerKind::compute, dataset.points.grid, view, 100'000);
  const double read = static_cast<double>(dataset.tree->bytes_read()) / static_cast<double>(bytes_in(folder));
  EXPECT_EQ(dataset.tree->bytes_read(), method->counts().bytes_read);
  EXPECT_LT(read, 0.03) << "of a tree of which " << seen << " is in sight";
  EXPECT_GT(read, 0.005);
  testing::Test::RecordProperty("share_in_sight", std::to_string(seen));
  testing::Test::RecordProperty("share_read", std::to_string(read));
}

TEST(TreeLookup, AViewOfOnePercentOfAnEptReadsAboutAsMuch) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree = plane_tree();
  files.levels_a_page = 3;
  expect_to_read_little(files.write(folder), from_above(kCube, 0.1, kPlace));
}

TEST(TreeLookup, AViewOfOnePercentOfAPotree1TreeReadsAboutAsMuch) {
  const ScratchFolder folder;
  Potree1Files files;
  files.tree = plane_tree();
  files.version = "1.8";
  files.step_size = 4;
  expect_to_read_little(files.write(folder), from_above(kCube, 0.1, kPlace));
}

TEST(TreeLookup, AViewOfOnePercentOfAPotree2TreeReadsAboutAsMuch) {
  const ScratchFolder folder;
  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(make_scene("terrain", 6'000'000, 1));
  BuildMonitor monitor;
  build_tree(sources, folder.path("tree"), {}, monitor);
  const RootCube cube = open_tree(folder.path("tree"))->info().cube;
  expect_to_read_little(folder.path("tree"), from_above(cube, 0.1, kPlace));
}

// Every node in sight looked up, as frames would.
void finish(TreeSupply& supply) {
  while (supply.searching()) {
    supply.discovered();
    supply.collect(0);
  }
}

std::unique_ptr<TreeSupply> supply_of(const std::string& folder) {
  return std::make_unique<TreeSupply>(open_tree(folder), ColorMap{.attribute = "height"});
}

TEST(TreeLookup, ANarrowViewReadsThePiecesInSight) {
  const ScratchFolder folder;
  Potree1Files files;
  files.tree = plane_tree(5);
  files.version = "1.8";
  files.step_size = 2;
  const auto supply = supply_of(files.write(folder));
  // 16 pieces begin on level 2, 256 on level 4
  supply->visible(from_above(kCube, 0.01, kPlace));
  finish(*supply);
  EXPECT_GE(supply->pieces_read(), 2u);
  EXPECT_LE(supply->pieces_read(), 8u);
  const std::uint64_t narrow = supply->pieces_read();
  // The same again: all of it is known
  EXPECT_FALSE(supply->visible(from_above(kCube, 0.01, kPlace)).empty());
  EXPECT_FALSE(supply->searching());
  EXPECT_EQ(supply->pieces_read(), narrow);
  supply->visible(from_above(kCube, 3.0, kPlace));
  finish(*supply);
  EXPECT_EQ(supply->pieces_read(), 16u + 256u);
}

TEST(TreeLookup, MovingOnForgetsWhatWasNotBegun) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree = plane_tree(4);
  const auto supply = supply_of(files.write(folder));
  for (int i = 0; i < 200; ++i) {
    supply->visible(from_above(kCube, i % 2 ? 3.0 : 0.05, kPlace + 0.001 * glm::dvec2(i, -i)));
    if (i % 3 == 0) supply->discovered();
  }
  std::size_t points = 0;
  const View all = from_above(kCube, 4.0, {0.5, 0.5});
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

TEST(TreeLookup, AFrameDoesNotWaitForTheDisk) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree = plane_tree(3);
  const auto store = std::make_shared<GatedStore>(open_tree(files.write(folder)));
  Hierarchical method(std::make_unique<TreeSupply>(store, ColorMap{.attribute = "height"}), 100'000);
  const View view = from_above(kCube, 3.0, kPlace);
  const auto start = std::chrono::steady_clock::now();
  method.start_view(view);
  for (int frame = 0; frame < 10; ++frame) EXPECT_EQ(method.select(100'000).points, 0u);
  // Ten times the patience for which a frame may hope, and a slow machine
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(5));
  EXPECT_FALSE(method.finished());
  store->open();
  std::uint64_t points = 0;
  while (!method.finished()) points += method.select(100'000).points;
  EXPECT_EQ(points, files.tree.points());
}

TEST(TreeLookup, APieceThatCannotBeReadIsAnErrorOfTheViewThatSeesIt) {
  const ScratchFolder folder;
  Potree1Files files;
  files.version = "1.8";
  files.write(folder);
  std::filesystem::remove(folder.path("data/r/7/r7.hrc"));
  const auto supply = supply_of(folder.path(""));
  // Child 0 is at the low corner, child 7 at the high one
  supply->visible(from_above(kCube, 0.2, {0.25, 0.25}));
  finish(*supply);
  supply->visible(from_above(kCube, 0.2, {0.75, 0.75}));
  EXPECT_TRUE(contains(error_of([&] { finish(*supply); }), "data/r/7/r7.hrc: there is no such file"));
}

TEST(TreeLookup, EveryNodeHasIdsOfItsOwn) {
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
}  // namespace stipple::test
