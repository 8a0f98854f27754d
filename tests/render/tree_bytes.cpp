// How much the hierarchical method reads of a tree on disk.
#include <gtest/gtest.h>

#include "octree/build/stream/tree_builder.h"
#include "src/scene/scene.h"
#include "tests/render/gl_test.h"
#include "tests/supply/plane_tree.h"

namespace stipple::test::render_tree_bytes {
namespace {

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

TEST(TreeBytes, AViewOfOnePercentOfAnEptReadsAboutAsMuch) {
  const ScratchFolder folder;
  EptFiles files;
  files.tree = plane_tree();
  files.levels_a_page = 3;
  expect_to_read_little(files.write(folder), from_above(kPlaneCube, 0.1, kPlace));
}

TEST(TreeBytes, AViewOfOnePercentOfAPotree1TreeReadsAboutAsMuch) {
  const ScratchFolder folder;
  Potree1Files files;
  files.tree = plane_tree();
  files.version = "1.8";
  files.step_size = 4;
  expect_to_read_little(files.write(folder), from_above(kPlaneCube, 0.1, kPlace));
}

TEST(TreeBytes, AViewOfOnePercentOfAPotree2TreeReadsAboutAsMuch) {
  const ScratchFolder folder;
  std::vector<std::unique_ptr<PointSource>> sources;
  sources.push_back(make_scene("terrain", 2'500'000, 1));
  BuildMonitor monitor;
  build_tree(sources, folder.path("tree"), {}, monitor);
  const RootCube cube = open_tree(folder.path("tree"))->info().cube;
  expect_to_read_little(folder.path("tree"), from_above(cube, 0.1, kPlace));
}

}  // namespace
}  // namespace stipple::test::render_tree_bytes
