// One grid for files that have different ones.
#include "octree/build/stream/common_grid.h"
#include "tests/octree/stream_build_fixture.h"

namespace stipple::test::octree_stream_build_grid {
namespace {

GriddedBox box_at(const glm::dvec3& offset, double scale, const glm::ivec3& min, const glm::ivec3& max) {
  return {{offset, glm::dvec3(scale)}, {min, max}};
}

// The largest rounding of the boxes' corners and a few positions between them.
double largest_rounding(const std::vector<GriddedBox>& boxes, const Grid& grid) {
  double largest = 0.0;
  for (const GriddedBox& box : boxes) {
    const GridTransform transform(box.grid, grid);
    for (const glm::ivec3& p : random_positions(1000, box.box, 3)) {
      const glm::dvec3 moved = grid.world_from_grid(transform(p));
      const glm::dvec3 off = glm::abs(moved - box.grid.world_from_grid(p));
      largest = std::max({largest, off.x, off.y, off.z});
    }
  }
  return largest;
}

TEST(CommonGrid, OfOneGridIsThatGridWhateverTheBounds) {
  constexpr int kLow = std::numeric_limits<int>::min(), kHigh = std::numeric_limits<int>::max();
  const std::vector<GriddedBox> boxes(2, box_at({1, 2, 3}, 0.01, glm::ivec3(kLow), glm::ivec3(kHigh)));
  EXPECT_EQ(common_grid(boxes).offset, glm::dvec3(1, 2, 3));
  EXPECT_EQ(common_grid(boxes).scale, glm::dvec3(0.01));
}

TEST(CommonGrid, OfTilesWithOneScaleKeepsItAndIsExact) {
  const std::vector<GriddedBox> tiles{box_at({637000, 851000, 0}, 0.01, {0, 0, 0}, {100'000, 100'000, 5'000}),
                                      box_at({638000, 851000.25, 100}, 0.01, {-500, 0, 0}, {100'000, 100'000, 5'000})};
  const Grid grid = common_grid(tiles);
  EXPECT_EQ(grid.scale, glm::dvec3(0.01));
  EXPECT_LT(largest_rounding(tiles, grid), 1e-8);
  const GridTransform transform(tiles[1].grid, grid);
  EXPECT_EQ(transform({7, 7, 7}), glm::ivec3(100'007, 32, 10'007));
  EXPECT_EQ(transform.rounding({7, 7, 7}), 0.0);
}

TEST(CommonGrid, OfDifferentScalesIsTheirCommonDivisor) {
  const std::vector<GriddedBox> tiles{box_at({0, 0, 0}, 0.025, {0, 0, 0}, {40'000, 40'000, 400}),
                                      box_at({1000, 0, 0}, 0.01, {0, 0, 0}, {100'000, 100'000, 1'000})};
  const Grid grid = common_grid(tiles);
  EXPECT_NEAR(grid.scale.x, 0.005, 1e-12);
  EXPECT_LT(largest_rounding(tiles, grid), 1e-8);
}

TEST(CommonGrid, OfTilesTooFarApartIsAsFineAsFits) {
  const std::vector<GriddedBox> tiles{box_at({0, 0, 0}, 0.001, {0, 0, 0}, {1000, 1000, 1000}),
                                      box_at({3e7, 0, 0}, 0.001, {0, 0, 0}, {1000, 1000, 1000})};
  const Grid grid = common_grid(tiles);
  EXPECT_GT(grid.scale.x, 0.006);
  EXPECT_LT(grid.scale.x, 0.021);
  EXPECT_LE(largest_rounding(tiles, grid), grid.scale.x * 0.501);
}

TEST_F(StreamBuild, PutsTilesOfDifferentGridsOnOne) {
  TestCloud left{"left", random_positions(3'000, {{0, 0, 0}, {9'999, 9'999, 500}}, 1)};
  TestCloud right = left;
  left.grid = {{1000.0, 0.0, 0.0}, glm::dvec3(0.01)};
  right.grid = {{1100.5, 20.0, 0.0}, glm::dvec3(0.005)};
  Sources sources;
  sources.push_back(std::make_unique<CloudSource>(left));
  sources.push_back(std::make_unique<CloudSource>(right));
  const BuildReport report = build(sources, "tree", small_nodes());
  EXPECT_EQ(report.largest_rounding, 0.0);
  const ReadTree tree = read_tree(path("tree"));
  std::vector<std::array<std::int64_t, 3>> expected, found;  // millimetres
  const auto add = [](const Grid& grid, const auto& positions, auto& list) {
    for (const glm::ivec3& p : positions) {
      const glm::dvec3 mm = glm::round(grid.world_from_grid(p) * 1000.0);
      list.push_back(
          {static_cast<std::int64_t>(mm.x), static_cast<std::int64_t>(mm.y), static_cast<std::int64_t>(mm.z)});
    }
  };
  add(left.grid, left.positions, expected);
  add(right.grid, right.positions, expected);
  for (const ReadNode& node : tree.nodes) add(tree.info.source.grid, node.points.positions, found);
  std::ranges::sort(expected);
  std::ranges::sort(found);
  EXPECT_EQ(found, expected);
}

TEST_F(StreamBuild, RightsWrongHeaderBounds) {
  const TestCloud cloud{"terrain", terrain(20'000, 5)};
  Sources lying = sources_of(cloud);
  static_cast<CloudSource&>(*lying.front()).info().stated_bounds = {glm::dvec3(0.0), glm::dvec3(1.0)};
  build(lying, "lying", small_nodes());
  build(sources_of(cloud), "honest", small_nodes());
  EXPECT_TRUE(file_content(path("lying/octree.bin")) == file_content(path("honest/octree.bin")));
}

TEST_F(StreamBuild, JoinsSchemasOfDifferentFiles) {
  const TestCloud cloud{"few", random_positions(100, {{0, 0, 0}, {99, 99, 99}}, 1)};
  Sources sources = sources_of(cloud);
  sources.push_back(std::make_unique<CloudSource>(cloud));
  SourceInfo& second = static_cast<CloudSource&>(*sources.back()).info();
  second.schema[0].scale = 0.5;           // no common type but double
  second.schema[2].name = "other class";  // only there
  build(sources, "tree", small_nodes());
  const ReadTree tree = read_tree(path("tree"));
  const Schema& schema = tree.info.source.schema;
  ASSERT_EQ(schema.size(), 5u);
  EXPECT_EQ(schema[0].type, ScalarType::f64);
  EXPECT_EQ(schema[1].type, ScalarType::u16);
  EXPECT_TRUE(find_attribute(schema, "other class"));
  double sum = 0.0;
  for (const ReadNode& node : tree.nodes)
    for (std::size_t i = 0; i < node.points.positions.size(); ++i) sum += value_at(node.points.columns[0], i);
  EXPECT_DOUBLE_EQ(sum, 1.5 * 7 * 99 * 50);
}

}  // namespace
}  // namespace stipple::test::octree_stream_build_grid
