// Vertices of OBJ files.
#include "tests/read/read_fixture.h"

namespace stipple::test::read_obj {
namespace {

using Doubles = std::vector<double>;
using Points = std::vector<glm::dvec3>;

using Obj = TableFiles;

TEST_F(Obj, VerticesAreReadAndEverythingElseIsSkipped) {
  const Cloud cloud = load(
      "# made by hand\nmtllib a.mtl\no cube\n\nv 1 2 3\n  v 4\t5 6 # last\nvt 0.5 0.5\nvn 0 0 1\ng top\nusemtl m\ns "
      "off\n"
      "f 1/1/1 2/2/2 1//1\nv -7.5 8e1 .25\nl 1 2\ncurv2 1 2\n");
  EXPECT_EQ(worlds(cloud), (Points{{1, 2, 3}, {4, 5, 6}, {-7.5, 80, 0.25}}));
  EXPECT_EQ(cloud.info.format, "OBJ");
  EXPECT_EQ(cloud.info.encoding, "text, vertices");
  EXPECT_EQ(cloud.info.schema, Schema{});
  EXPECT_EQ(cloud.info.warnings, Strings{});
}

TEST_F(Obj, ColorsFollowThePositionOrTheWeight) {
  EXPECT_EQ(values(load("v 1 2 3 0 0.5 1\nv 1 2 3 1 1 0.2\n"), "rgb"), (Doubles{0, 32768, 65535, 65535, 65535, 13107}));
  EXPECT_EQ(values(load("v 1 2 3 0 128 255\n"), "rgb"), (Doubles{0, 128 * 257, 65535}));
  const Cloud weighted = load("v 1 2 3 0.5 0 0.5 1\n");
  EXPECT_EQ(values(weighted, "rgb"), (Doubles{0, 32768, 65535}));
  EXPECT_EQ(worlds(weighted), (Points{{1, 2, 3}}));
  EXPECT_TRUE(one_that_contains(weighted.info.warnings, "weight"));
}

TEST_F(Obj, VerticesWithoutAColorAmongOthersAreWhite) {
  const Cloud cloud = load("v 1 2 3\nv 4 5 6 0 0 0.5\nv 7 8 9\n");
  EXPECT_EQ(values(cloud, "rgb"), (Doubles{65535, 65535, 65535, 0, 0, 32768, 65535, 65535, 65535}));
  EXPECT_TRUE(one_that_contains(cloud.info.warnings, "2 of 3 vertices have no colour"));
}

TEST_F(Obj, IsToldByItsFirstWord) {
  for (const char* start : {"v 1 2 3\n", "mtllib x.mtl\nv 1 2 3\n", "# OBJ\no a\nv 1 2 3\n", "vn 0 0 1\nv 1 2 3\n",
                            "f 1 1 1\nv 1 2 3\n", "g\tall\r\nv 1 2 3\r\n"})
    EXPECT_EQ(open(start)->info().format, "OBJ") << start;
  for (const char* start : {"1 2 3\n", "x y z\n1 2 3\n", "# v 1 2 3\n1 2 3\n"})
    EXPECT_EQ(open(start)->info().format, "text") << start;
  for (const char* start : {"v x y\n", "vertices 1 2 3\n", "once upon a time\n", "f(x) = 3\n"})
    EXPECT_TRUE(contains(error(start), "no point cloud that is read")) << start;
}

TEST_F(Obj, FaultsNameTheLine) {
  EXPECT_TRUE(contains(error("v 1 2 3\nv 1 2\n"), "line 2: the vertex has 2 values"));
  EXPECT_TRUE(contains(error("v 1 2 3\n\nv 1 2 3 4 5\n"), "line 3: the vertex has 5 values"));
  EXPECT_TRUE(contains(error("v 1 2 3\nf 1\nv 1 two 3\n"), "line 3: value 2 of the vertex is no number"));
}

TEST_F(Obj, WithoutVerticesTheCloudIsEmpty) {
  EXPECT_EQ(load("o nothing\n").size(), 0u);
}

}  // namespace
}  // namespace stipple::test::read_obj
