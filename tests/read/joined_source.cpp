// Several files as one cloud.
#include "octree/open/joined_source.h"

#include <fmt/format.h>

#include "tests/read/read_fixture.h"

namespace stipple::test::read_joined_source {
namespace {

using Doubles = std::vector<double>;
using Points = std::vector<glm::dvec3>;

class Joined : public TableFiles {
 protected:
  std::string write(const std::string& name, const std::string& content) const {
    return write_text(folder, name, content);
  }
};

TEST_F(Joined, PointsStandInTheOrderOfThePaths) {
  const std::string a = write("a.xyz", "1 2 3\n4 5 6\n"), b = write("b.xyz", "0.001 0 0\n"),
                    c = write("c.xyz", "7 8 9\n");
  const Points read = worlds(load_all(*open_source(std::vector{c, a, b})));
  const Points expected{{7, 8, 9}, {1, 2, 3}, {4, 5, 6}, {0.001, 0, 0}};
  ASSERT_EQ(read.size(), expected.size());
  // The step that powers of two and of ten have in common is no exact double
  for (std::size_t i = 0; i < read.size(); ++i)
    for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(read[i][axis], expected[i][axis], 1e-10);
}

TEST_F(Joined, OneFileIsItself) {
  const std::string a = write("a.xyz", "1 2 3\n");
  EXPECT_EQ(open_source(std::vector{a})->info().format, "text");
}

TEST_F(Joined, AFolderIsItsFilesByName) {
  std::filesystem::create_directories(folder.path("tiles/below"));
  for (const int i : {3, 1, 2}) write(fmt::format("tiles/{}.XYZ", i), fmt::format("{} 0 0\n", i));
  write("tiles/readme.txt", "no cloud");
  write("tiles/below/4.xyz", "4 0 0\n");
  const Cloud cloud = load_all(*open_source(folder.path("tiles")));
  EXPECT_EQ(worlds(cloud), (Points{{1, 0, 0}, {2, 0, 0}, {3, 0, 0}}));
  EXPECT_EQ(cloud.info.path, folder.path("tiles"));
  EXPECT_EQ(cloud.info.format, "text");
  std::filesystem::create_directories(folder.path("empty"));
  EXPECT_TRUE(contains(error_of([&] { open_source(folder.path("empty")); }), "holds no point cloud files"));
}

TEST_F(Joined, AttributesOfOneNameAreOneColumn) {
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\n";
  const std::string a = write("a.ply", ply +
                                           "property uchar intensity\nproperty uchar red\nproperty uchar green\n"
                                           "property uchar blue\nend_header\n1 2 3 200 1 2 3\n");
  const std::string b = write("b.ply", ply + "property float intensity\nproperty int id\nend_header\n4 5 6 0.5 -9\n");
  const Cloud cloud = load_all(*open_source(std::vector{a, b}));
  EXPECT_EQ(cloud.info.format, "PLY");
  EXPECT_EQ(values(cloud, "intensity"), (Doubles{200, 0.5}));
  EXPECT_EQ(values(cloud, "id"), (Doubles{0, -9}));
  EXPECT_EQ(values(cloud, "rgb"), (Doubles{257, 514, 771, 0, 0, 0}));
}

TEST_F(Joined, WarningsAndDroppedPointsAreThoseOfAll) {
  const std::string a = write("a.xyz", "nan 2 3\n4 5 6\n"), b = write("b.xyz", "1 2 inf\n");
  const auto source = open_source(std::vector{a, b});
  EXPECT_EQ(source->info().point_count, 1u);
  EXPECT_EQ(source->info().dropped_points, 2u);
  ASSERT_EQ(source->info().warnings.size(), 2u);
  EXPECT_TRUE(contains(source->info().warnings[1], b + ": 1 of 1 points"));
}

TEST_F(Joined, AGridThatCannotBeExactIsAWarning) {
  const std::string a = write("a.xyz", "0.0000001 0 0\n1 1 1\n"), b = write("b.xyz", "5000000.01 0 0\n5000001 1 1\n");
  const auto source = open_source(std::vector{a, b});
  EXPECT_TRUE(one_that_contains(source->info().warnings, "no common grid"));
  const auto read = worlds(load_all(*source));
  EXPECT_NEAR(read[2].x, 5000000.01, 0.01);
}

}  // namespace
}  // namespace stipple::test::read_joined_source
