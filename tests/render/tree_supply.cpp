// Methods that draw trees which stay on disk.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <tuple>

#include "octree/core/error.h"
#include "render/frame/propose_views.h"
#include "render/method/progressive_renderer.h"
#include "tests/render/gl_test.h"

namespace stipple::test::render_tree_supply {
namespace {

// Trees of the shared data: of Potree 2, with records and packed by Brotli; with a file for every node, of records and
// of LAZ.
class TreesOnDisk : public testing::TestWithParam<std::tuple<const char*, Mode>> {
 protected:
  void SetUp() override {
    const std::filesystem::path path = std::filesystem::path(STIPPLE_SHARED_DATA) / std::get<0>(GetParam());
    if (!std::filesystem::exists(path)) GTEST_SKIP() << path << " is missing: real trees are not tested";
    path_ = path;
  }
  Mode mode() const { return std::get<1>(GetParam()); }
  std::string path_;
};
INSTANTIATE_TEST_SUITE_P(
    All, TreesOnDisk,
    testing::Combine(testing::Values("derived/potree2/huacayccancha-uncompressed", "derived/potree2/lion-brotli",
                                     "potree+potree/lion_takanawa_ept_bin", "PDAL+PDAL/ept/lone-star-laszip",
                                     "r-lidar+lasR/extdata/ept-test-multi", "potree+potree/lion_takanawa",
                                     "healthinnovation+huacayccancha/index", "potree+potree/lion_takanawa_laz",
                                     "potree+potree/lion_takanawa.copc.laz"),
                     testing::Values(Mode::hierarchical, Mode::hybrid)),
    [](const auto& param) {
      std::string name = std::string(std::get<0>(param.param)) + "_" + std::string(name_of(std::get<1>(param.param)));
      for (char& c : name) c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
      return name;
    });

View view_of_tree(const Dataset& dataset, const std::string& name) {
  for (const NamedCamera& named : propose_cameras(dataset.overview(), 16.0 / 9.0))
    if (named.name == name) return make_view(named.camera, {320, 180}, near_plane(dataset.points.grid));
  return {};
}

TEST_P(TreesOnDisk, ConvergeToBruteForceWithoutBeingLoaded) {
  const Dataset loaded = open_dataset(path_, "", {});
  const Dataset on_disk = open_dataset(path_, "", {.points = false, .octree = true});
  EXPECT_EQ(on_disk.points.size(), 0u);
  const auto method = make_method(mode(), on_disk, {.largest_budget = 50'000});
  for (const char* camera : {"oblique", "low", "aerial"}) {
    const View view = view_of_tree(on_disk, camera);
    EXPECT_TRUE(same_picture(converged_picture(*method, RasterizerKind::compute, on_disk.points.grid, view, 50'000),
                             brute_force_picture(loaded.points, RasterizerKind::compute, view)))
        << camera;
  }
}

TEST_P(TreesOnDisk, ANewViewForgetsWhatTheOldOneAskedFor) {
  const Dataset loaded = open_dataset(path_, "", {});
  const Dataset on_disk = open_dataset(path_, "", {.points = false, .octree = true});
  const auto method = make_method(mode(), on_disk, {.largest_budget = 20'000});
  ProgressiveRenderer renderer(*method, RasterizerKind::compute, on_disk.points.grid);
  for (int frame = 0; frame < 3; ++frame) renderer.draw(view_of_tree(on_disk, "oblique"), 20'000);
  const View view = view_of_tree(on_disk, "low");
  while (!renderer.draw(view, 20'000).converged) {
  }
  EXPECT_TRUE(same_picture(renderer.read(), brute_force_picture(loaded.points, RasterizerKind::compute, view)));
}

TEST_P(TreesOnDisk, AViewOfAPartReadsAPart) {
  const Dataset on_disk = open_dataset(path_, "", {.points = false, .octree = true});
  const std::vector<StoredNode> nodes = locate_all(*on_disk.tree, read_whole_hierarchy(*on_disk.tree));
  if (nodes.size() < 50) GTEST_SKIP() << "too few nodes for a view to leave some out";
  const std::uint64_t before = on_disk.tree->bytes_read();
  const auto method = make_method(mode(), on_disk, {.largest_budget = 1'000'000});
  View view = view_of_tree(on_disk, "aerial");
  view.cot_x *= 10.0;  // a hundredth of the picture
  view.cot_y *= 10.0;
  converged_picture(*method, RasterizerKind::compute, on_disk.points.grid, view, 1'000'000);
  // The trees are small: their upper levels, which every view touches, hold half of them
  std::uint64_t all = 0;
  for (const StoredNode& node : nodes) all += node.byte_size;
  EXPECT_GT(on_disk.tree->bytes_read(), before);
  EXPECT_LT(on_disk.tree->bytes_read() - before, all * 3 / 4);
}

class TreeOnDisk : public testing::TestWithParam<Mode> {};
INSTANTIATE_TEST_SUITE_P(Modes, TreeOnDisk, testing::Values(Mode::hierarchical, Mode::hybrid),
                         [](const auto& param) { return std::string(name_of(param.param)); });

TEST_P(TreeOnDisk, OfAFileThatBreaksOffTheRestIsDrawn) {
  const std::filesystem::path original =
      std::filesystem::path(STIPPLE_SHARED_DATA) / "derived/potree2/huacayccancha-uncompressed";
  if (!std::filesystem::exists(original)) GTEST_SKIP() << original << " is missing: real trees are not tested";
  const std::filesystem::path copy =
      std::filesystem::temp_directory_path() / ("stipple-broken-tree-" + std::to_string(getpid()));
  std::filesystem::copy(original, copy, std::filesystem::copy_options::recursive);
  {
    const Dataset on_disk = open_dataset(copy, "", {.points = false, .octree = true});
    // After it was opened: as when a disk goes away
    std::filesystem::resize_file(copy / "octree.bin", std::filesystem::file_size(copy / "octree.bin") / 4);
    const auto method = make_method(GetParam(), on_disk, {.largest_budget = 50'000});
    const View view = view_of_tree(on_disk, "oblique");
    EXPECT_GT(converged_picture(*method, RasterizerKind::compute, on_disk.points.grid, view, 50'000).covered_pixels(),
              0u);
    EXPECT_GT(method->unread().parts, 0u);
  }
  std::filesystem::remove_all(copy);
}

}  // namespace
}  // namespace stipple::test::render_tree_supply
