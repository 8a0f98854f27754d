#include <gtest/gtest.h>

#include <random>

#include "src/check/compare_points.h"
#include "tests/octree/potree2_files.h"

namespace stipple::test::octree_check_compare {
namespace {

using test::contains;
using test::ScratchFolder;
using test::TreeFiles;
using test::TreePoint;

// Points in memory, in the order given, on any grid.
class MemorySource : public PointSource {
 public:
  MemorySource(std::vector<TreePoint> points, const Grid& grid) : points_(std::move(points)) {
    info_.path = "memory";
    info_.grid = grid;
    info_.point_count = points_.size();
    info_.schema = {{"classification", ScalarType::u8}, {"intensity", ScalarType::u16}, {"rgb", ScalarType::u16, 3}};
  }
  SourceInfo& info() { return info_; }
  const SourceInfo& info() const override { return info_; }

  void read(std::span<const std::size_t> attributes, const BatchConsumer& consume) const override {
    PointBatch batch;
    for (const TreePoint& point : points_) batch.positions.push_back(point.position);
    for (const std::size_t a : attributes) {
      Column column{info_.schema.at(a), {}};
      column.resize(points_.size());
      for (std::size_t i = 0; i < points_.size(); ++i) fill(column, i, points_[i]);
      batch.columns.push_back(column);
    }
    consume(batch);
  }

 private:
  static void fill(Column& column, std::size_t i, const TreePoint& point) {
    if (column.attribute.name == "classification") column.as<std::uint8_t>()[i] = point.classification;
    if (column.attribute.name == "intensity") column.as<std::uint16_t>()[i] = point.intensity;
    for (int c = 0; column.attribute.name == "rgb" && c < 3; ++c) column.as<std::uint16_t>()[3 * i + c] = point.rgb[c];
  }

  SourceInfo info_;
  std::vector<TreePoint> points_;
};

const Grid kTreeGrid{{100.0, 200.0, 300.0}, glm::dvec3(0.5)};

class ComparePoints : public testing::Test {
 protected:
  ComparePoints() : tree_(open_tree(files_.write(folder_))) {}

  std::vector<TreePoint> shuffled() const {
    std::vector<TreePoint> points = files_.all_points();
    std::shuffle(points.begin(), points.end(), std::mt19937(1));
    return points;
  }

  Comparison compare(std::vector<TreePoint> points, const Grid& grid = kTreeGrid) {
    std::vector<std::unique_ptr<PointSource>> inputs;
    inputs.push_back(std::make_unique<MemorySource>(std::move(points), grid));
    return compare_points(tree_, inputs);
  }

  ScratchFolder folder_;
  TreeFiles files_ = TreeFiles::usual();
  TreeSource tree_;
};

TEST_F(ComparePoints, TheOrderDoesNotMatter) {
  const Comparison result = compare(shuffled());
  EXPECT_FALSE(result.defect) << result.defect->what;
  EXPECT_EQ(result.input_points, 360u);
  EXPECT_EQ(result.largest_rounding, 0.0);
  EXPECT_EQ(result.compared, (std::vector<std::string>{"intensity", "rgb", "classification"}));
}

TEST_F(ComparePoints, InputsAreTakenTogether) {
  const std::vector<TreePoint> points = shuffled();
  std::vector<std::unique_ptr<PointSource>> inputs;
  inputs.push_back(std::make_unique<MemorySource>(std::vector(points.begin(), points.begin() + 100), kTreeGrid));
  inputs.push_back(std::make_unique<MemorySource>(std::vector(points.begin() + 100, points.end()), kTreeGrid));
  EXPECT_FALSE(compare_points(tree_, inputs).defect);
}

TEST_F(ComparePoints, EncodingsOfOnePointAreEqual) {
  const ScratchFolder other;
  std::vector<std::unique_ptr<PointSource>> inputs;
  inputs.push_back(open_source(TreeFiles::usual("BROTLI").write(other)));
  EXPECT_FALSE(compare_points(tree_, inputs).defect);
}

TEST_F(ComparePoints, APointThatTheInputsLackIsNamedWithItsNode) {
  std::vector<TreePoint> points = files_.all_points();
  points.erase(points.begin() + 4 * 60 + 7);  // of r7
  const Comparison result = compare(points);
  ASSERT_TRUE(result.defect);
  EXPECT_EQ(result.defect->node, "r7");
  EXPECT_TRUE(contains(result.defect->what, "its point is 1 times in the tree and 0 times in the inputs"));
  EXPECT_TRUE(contains(result.defect->what, "intensity 2007, rgb 7000 7077 7154, classification 2"));
}

TEST_F(ComparePoints, APointThatTheTreeLacksIsNamedWithItsInput) {
  std::vector<TreePoint> points = files_.all_points();
  points.push_back({{1, 2, 3}, 4, {5, 6, 7}, 8});
  const Comparison result = compare(points);
  ASSERT_TRUE(result.defect);
  EXPECT_EQ(result.defect->node, "");
  EXPECT_TRUE(contains(result.defect->what, "point 360 of memory is not in the tree"));
  EXPECT_TRUE(contains(result.defect->what, "(100.5, 201, 301.5), intensity 4, rgb 5 6 7, classification 8"));
}

TEST_F(ComparePoints, HowOftenAPointIsThereCounts) {
  std::vector<TreePoint> points = files_.all_points();
  points[300] = points[0];
  ASSERT_TRUE(compare(points).defect);
  points = files_.all_points();
  points.push_back(points[5]);
  const Comparison result = compare(points);
  ASSERT_TRUE(result.defect);
  EXPECT_EQ(result.defect->node, "r");
  EXPECT_TRUE(contains(result.defect->what, "1 times in the tree and 2 times in the inputs"));
}

TEST_F(ComparePoints, AttributesThatChangedPlacesAreADefect) {
  std::vector<TreePoint> points = files_.all_points();
  std::swap(points[10].intensity, points[70].intensity);
  EXPECT_TRUE(compare(points).defect);
  points = files_.all_points();
  std::swap(points[10].rgb[0], points[10].rgb[1]);
  EXPECT_TRUE(compare(points).defect);
}

TEST_F(ComparePoints, AnyOneOfManyChangesIsFound) {
  const std::vector<TreePoint> whole = files_.all_points();
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::vector<TreePoint> points = whole;
    points[i].position[static_cast<int>(i % 3)] ^= 1 << i % 11;
    ASSERT_TRUE(compare(points).defect) << "point " << i;
  }
}

TEST_F(ComparePoints, AnotherGridIsRoundedAndTheLargestRoundingSaid) {
  // World 0.125 off the tree's grid: a quarter of a step
  const Grid quarter{{100.125, 200.0, 300.0}, glm::dvec3(0.5)};
  const Comparison rounded = compare(shuffled(), quarter);
  EXPECT_FALSE(rounded.defect);
  EXPECT_NEAR(rounded.largest_rounding, 0.125, 1e-12);
  // The same places on a finer grid that begins elsewhere
  std::vector<TreePoint> points = shuffled();
  for (TreePoint& point : points) point.position = 50 * (point.position + glm::ivec3(1000));
  const Comparison finer = compare(points, {glm::dvec3(100.0, 200.0, 300.0) - 500.0, glm::dvec3(0.01)});
  EXPECT_FALSE(finer.defect) << finer.defect->what;
  EXPECT_EQ(finer.largest_rounding, 0.0);
}

TEST_F(ComparePoints, AttributesOfOneSideAreNamedAndNotCompared) {
  auto input = std::make_unique<MemorySource>(shuffled(), kTreeGrid);
  input->info().schema[1].name = "reflectance";
  std::vector<std::unique_ptr<PointSource>> inputs;
  inputs.push_back(std::move(input));
  const Comparison result = compare_points(tree_, inputs);
  EXPECT_FALSE(result.defect);
  EXPECT_EQ(result.in_tree_only, std::vector<std::string>{"intensity"});
  EXPECT_EQ(result.in_inputs_only, std::vector<std::string>{"reflectance"});
}

TEST_F(ComparePoints, WhatOneOfTheInputsLacksIsZero) {
  TreeFiles files = TreeFiles::usual();
  for (TreePoint& point : files.nodes["r3"]) point.intensity = 0;
  const ScratchFolder folder;
  const TreeSource tree(open_tree(files.write(folder)));
  const std::vector<TreePoint> r3 = files.nodes["r3"];
  files.nodes["r3"].clear();
  std::vector<std::unique_ptr<PointSource>> inputs;
  inputs.push_back(std::make_unique<MemorySource>(files.all_points(), kTreeGrid));
  auto without = std::make_unique<MemorySource>(r3, kTreeGrid);
  without->info().schema.erase(without->info().schema.begin() + 1);
  inputs.push_back(std::move(without));
  const Comparison result = compare_points(tree, inputs);
  EXPECT_FALSE(result.defect) << result.defect->what;
}

TEST_F(ComparePoints, AnotherTypeIsComparedByValue) {
  auto input = std::make_unique<MemorySource>(shuffled(), kTreeGrid);
  // Stored values of the tree are twice those of an attribute whose scale is two
  TreeFiles files = TreeFiles::usual();
  for (auto& [name, points] : files.nodes)
    for (TreePoint& point : points) point.intensity = static_cast<std::uint16_t>(2 * point.intensity);
  input->info().schema[1].scale = 2.0;
  const ScratchFolder folder;
  const TreeSource tree(open_tree(files.write(folder)));
  std::vector<std::unique_ptr<PointSource>> inputs;
  inputs.push_back(std::move(input));
  const Comparison result = compare_points(tree, inputs);
  EXPECT_FALSE(result.defect) << result.defect->what;
}

}  // namespace
}  // namespace stipple::test::octree_check_compare
